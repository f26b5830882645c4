/// A reference, prepared for the simulator, the state and the reward.
#pragma once

#include <array>
#include <memory>

#include "core/containers.h"
#include "motion/reference.h"
#include "physics/data.h"
#include "rl/tracking/state.h"
#include "rl/tracking/tracking_config.h"

namespace mimicx::rl::tracking {

/// A clip's poses, encoded and decoded by an option's auto-encoder.
struct EncodedReference {
  int code_size = 0;                               ///< entries of z
  List<float> codes;                               ///< [frames + 1][code_size] z = E(P)
  List<std::array<float, kPoseFeatures>> decoded;  ///< [frames + 1] D(z), own heading frame
};

/// A prepared reference: immutable, shared by packs and threads.
struct TrackingClip {
  motion::Reference reference;
  physics::Model<float> model;
  List<Pose> poses;                                ///< [frames + 1]: the last frame is repeated, at rest
  List<std::array<float, kJointFeatures>> joints;  ///< [frames + 1]
  List<KeypointFrame> keypoints;                   ///< [frames], or empty
  List<EncodedReference> encoded;                  ///< [option], or empty: the state has the reference itself
  List<int> arrangement;                           ///< [frames] option that acts at a frame; empty: option 0

  int option_at(int frame) const { return arrangement.empty() ? 0 : arrangement[frame]; }
  /// Length of s_t; the same for every option.
  int state_size() const { return encoded.empty() ? kStateSize : kEncodedRest + encoded.front().code_size; }
  int size() const { return poses.count() - 1; }
};
/// @throws std::invalid_argument unless the physics rate is a multiple of the motion's frame rate
void require_whole_steps(double physics_rate, double fps);

/// @throws std::invalid_argument for a reference of less than 2 frames, and as `require_whole_steps`
std::shared_ptr<const TrackingClip> make_tracking_clip(const motion::Reference& reference,
                                                       const TrackingConfig& config);

/// A frame, or all frames, as states of the simulator; a state as a frame.
physics::State<double> simulator_state(const motion::ReferenceFrame& frame);
List<physics::State<double>> simulator_states(const motion::Reference& reference);
motion::ReferenceFrame frame_of_state(const physics::State<double>& x);

/// Simulated states as a reference; its velocities are the simulator's, not differences.
/// @param of  gives name, body and rate
motion::Reference reference_of_states(const motion::Reference& of,
                                      const List<physics::State<double>>& states);

}  // namespace mimicx::rl::tracking
