/// One pack of simulated characters that follow one clip, one control step (1/30 s) at a time.
///
/// The reference and the model are shared and constant (`TrackingClip`); the pack holds the lanes' states.
/// Positions on the clip are per lane, so lanes of one pack may be anywhere on it. What this does not do: it
/// neither decides when an episode ends nor where the next one starts (rl/tracking/environment.h).
#pragma once

#include <array>
#include <bitset>
#include <memory>
#include <string>
#include <vector>

#include "motion/reference.h"
#include "physics/control_interval.h"
#include "rl/tracking/reward.h"
#include "rl/tracking/state.h"

namespace mimicx::rl {

/// What an action a_t ∈ R⁵⁵ means: a target pose as rotation vectors (angles for hinges).   METHOD §4
enum class ActionMode {
  kAbsolute,  ///< the paper's: the target itself
  kResidual,  ///< a rotation applied on top of the reference pose of frame t+1
};

struct TrackingConfig {
  ActionMode action_mode = ActionMode::kResidual;
  bool velocity_feed_forward = true;  ///< PD damps towards the reference's joint velocity, not towards 0
  double max_action = 2.5;            ///< each entry of an action is clamped to ± this, rad
  RewardWeights reward;
  SimulationOptions simulation;
  double terminate_distance = 0.4;  ///< a body farther than this from its reference ends the episode, m
  int bin_frames = 10;              ///< starts and failures are counted in bins of this many frames
  double uniform_starts = 0.4;      ///< share of the starts drawn uniformly; the rest where it fails
  double reward_target = 0.5;       ///< mean reward under which the learner's reward is softened; 0: never
  double softest_reward = 0.1;      ///< least exponent of the softened reward
};

/// What an option's encoder makes of a clip's poses.
struct EncodedReference {
  int code_size = 0;                                      ///< entries of z
  std::vector<float> codes;                               ///< [frames + 1][code_size] z = E(P)
  std::vector<std::array<float, kPoseFeatures>> decoded;  ///< [frames + 1] D(z), own heading frame
};

/// A reference made ready for the simulator: immutable, shared by packs and threads.
struct TrackingClip {
  Reference reference;
  Model<float> model;
  std::vector<Pose> poses;                                ///< [frames + 1]: the last one repeated, at rest
  std::vector<std::array<float, kJointFeatures>> joints;  ///< [frames + 1]
  std::vector<KeypointFrame> keypoints;                   ///< [frames], or empty
  std::vector<EncodedReference> encoded;  ///< [option], or empty: every policy sees the reference itself
  std::vector<int> arrangement;           ///< [frames] option that acts at a frame; empty: the first

  int option_at(int frame) const {
    return arrangement.empty() ? 0 : arrangement[static_cast<std::size_t>(frame)];
  }
  /// Length of s_t; the same for every option.
  int state_size() const { return encoded.empty() ? kStateSize : kEncodedRest + encoded.front().code_size; }
  int size() const { return static_cast<int>(poses.size()) - 1; }
};
/// @throws std::invalid_argument unless the physics rate is a multiple of the motion's frame rate
void require_whole_steps(double physics_rate, double fps);

/// @throws std::invalid_argument for a reference of less than 2 frames, and as `require_whole_steps`
std::shared_ptr<const TrackingClip> make_tracking_clip(const Reference& reference,
                                                       const TrackingConfig& config);

class TrackingPack {
 public:
  using P = Pack<kLanes>;
  using SubstepWatcher = mimicx::SubstepWatcher<P>;

  TrackingPack(std::shared_ptr<const TrackingClip> clip, const TrackingConfig& config);

  /// Puts a lane on the reference at `frame`, moving as the reference moves.
  void reset(int lane, int frame);
  /// Puts `lane` into the state of the lane `from`, of this pack or another one on the same clip.
  void copy_lane(int lane, const TrackingPack& other, int from);
  /// The lane's frame on the clip: its state belongs to this frame. 0 .. size()-1.
  int frame(int lane) const { return frames_[static_cast<std::size_t>(lane)]; }
  /// s_t [state_size of the clip] as the option sees it.
  void observe(int lane, int option, float* out) const;
  /// … as the option sees it that acts at the lane's frame.
  void observe(int lane, float* out) const { observe(lane, clip_->option_at(frame(lane)), out); }
  /// Sets what the lane aims at during the next control step. @param action  [55]
  void act(int lane, const float* action);
  /// One control step of every lane; frames advance by one. @param applied  sums of what acted, or null
  /// @param watch  sees every physics step and changes none; empty: nobody watches
  void advance(Data<P>& scratch, Applied<P>* applied = nullptr, const SubstepWatcher& watch = {});

  /// After `advance`: reward of the lane's pose against the frame it has reached.
  Reward reward(int lane) const;
  /// Largest distance of a body from its reference, m; infinite where the simulation went wrong.
  double worst_distance(int lane) const;
  /// Joints of the lane whose torque was at its bound in the last physics step.
  int saturated_joints(int lane) const { return saturated_[static_cast<std::size_t>(lane)]; }
  /// State of the lane as of the last reset or advance.
  const Pose& pose(int lane) const { return poses_[static_cast<std::size_t>(lane)]; }
  const TrackingClip& clip() const { return *clip_; }

  /// Everything that determines the pack's future, as 32-bit floats (frames included).
  std::vector<float> save() const;
  /// @throws std::invalid_argument when the size is not that of `save`.
  void load(const std::vector<float>& values);

 private:
  void read_pose(const Data<P>& d, int lane);

  std::shared_ptr<const TrackingClip> clip_;
  TrackingConfig config_;
  State<P> state_;
  Target<P> from_, to_;  ///< targets at the start and the end of the control step
  std::array<int, kLanes> frames_{};
  std::array<Pose, kLanes> poses_;
  std::bitset<kLanes> broken_;  ///< the simulation went wrong since the last reset
  std::bitset<kLanes> fresh_;   ///< reset and not advanced yet: the pose is the reference's own
  std::array<int, kLanes> saturated_{};
};

}  // namespace mimicx::rl
