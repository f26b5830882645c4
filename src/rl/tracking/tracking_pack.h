/// One pack of simulated characters that follow one clip, one control step (1/30 s) at a time.
///
/// The reference and the model are shared and constant (`TrackingClip`); the pack holds the lanes' states.
/// Each lane has its own frame on the clip. tracking_environment.h decides when an episode ends and where the
/// next one starts.
#pragma once

#include <memory>
#include <vector>

#include "physics/control_interval.h"
#include "rl/tracking/tracking_clip.h"

namespace mimicx::rl::tracking {

class TrackingPack {
 public:
  using P = physics::Pack<physics::kLanes>;
  using SubstepWatcher = physics::SubstepWatcher<P>;

  TrackingPack(std::shared_ptr<const TrackingClip> clip, const TrackingConfig& config);

  /// Puts a lane into the reference's state at `frame`, velocities included.
  void reset(int lane, int frame);
  /// Copies the state of lane `from`, of this pack or another one on the same clip, into `lane`.
  void copy_lane(int lane, const TrackingPack& other, int from);
  /// Adds `change` to the velocity of the lane's pelvis, world, m/s.
  void push(int lane, const Vector3d& change);
  /// The frame of the clip to which the lane's state belongs, 0 .. size()-1.
  int frame(int lane) const { return frames_[lane]; }
  /// s_t of an option, [state_size of the clip].
  void observe(int lane, int option, float* out) const;
  /// s_t of the option that acts at the lane's frame.
  void observe(int lane, float* out) const { observe(lane, clip_->option_at(frame(lane)), out); }
  /// Sets the lane's PD target of the next control step. @param action  [55]
  void act(int lane, const float* action);
  /// One control step of every lane; frames advance by one.
  /// @param applied  receives the sums of torques and forces; may be null
  /// @param watch  sees every physics step and changes none; may be empty
  void advance(physics::Data<P>& scratch, physics::Applied<P>* applied = nullptr,
               const SubstepWatcher& watch = {});

  /// After `advance`: reward of the lane's pose against the frame it has reached.
  Reward reward(int lane) const;
  /// Largest distance of a body from its reference, m; infinite if the simulation failed.
  double worst_distance(int lane) const;
  /// Joints of the lane whose torque was at its bound in the last physics step.
  int saturated_joints(int lane) const { return saturated_[lane]; }
  /// State of the lane as of the last reset or advance.
  const Pose& pose(int lane) const { return poses_[lane]; }
  /// The states of all lanes, as the simulator holds them.
  const physics::State<P>& state() const { return state_; }
  const TrackingClip& clip() const { return *clip_; }

  /// The complete state of the pack, frames included, as 32-bit floats.
  std::vector<float> save() const;
  /// @throws std::invalid_argument for another size than that of `save`, or a frame outside the clip
  void load(const std::vector<float>& values);

 private:
  void read_pose(const physics::Data<P>& d, int lane);

  std::shared_ptr<const TrackingClip> clip_;
  TrackingConfig config_;
  physics::State<P> state_;
  physics::Target<P> from_, to_;  ///< targets at the start and the end of the control step
  Array<int, physics::kLanes> frames_{};
  Array<Pose, physics::kLanes> poses_;
  Array<bool, physics::kLanes> broken_{};  ///< the simulation failed since the last reset
  Array<bool, physics::kLanes> fresh_{};   ///< reset and not advanced yet: the pose is the reference's
  Array<int, physics::kLanes> saturated_{};
};

}  // namespace mimicx::rl::tracking
