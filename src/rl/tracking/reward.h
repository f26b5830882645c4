/// The reward of the tracking task: Eq. 2 times Eq. 3.                      docs/method.md §5
///
/// Every factor is exp(−w · error) in (0, 1]. Errors are means over joints, so that the weights do not depend
/// on their number. The difference of rotations is the geodesic angle. The velocity term of Eq. 2 is
/// taken as the difference of the joints' angular velocities. Positions of hands and feet are local, as in
/// the paper: each relative to its own root, in the frame of that root, so that an error of the root counts
/// in the terms of the root only. Without keypoints Eq. 3 is exactly 1.
#pragma once

#include <string_view>

#include "core/containers.h"
#include "rl/tracking/keypoints.h"
#include "rl/tracking/state.h"

namespace mimicx::rl::tracking {

/// Defaults: docs/method.md §12 and docs/experiments.md.
struct RewardWeights {
  double root_position = 100.0;  ///< 1/m²
  double root_rotation = 8.0;    ///< 1/rad²
  double pose = 20.0;            ///< 1/rad², mean over the 21 joints
  double velocity = 0.05;        ///< s²/rad², mean over the 21 joints
  double end_effector = 40.0;    ///< 1/m², mean over hands and feet, in the root's frame
  double projection = 100.0;     ///< per (box height)², confidence-weighted mean over the keypoints
};

inline constexpr int kRewardTerms = 6;
inline constexpr Array<std::string_view, kRewardTerms> kRewardTermNames = {
    "root_position", "root_rotation", "pose", "velocity", "end_effector", "projection"};

struct Reward {
  double total = 0;                    ///< product of the terms
  Array<double, kRewardTerms> term{};  ///< order of kRewardTermNames
};

/// Eq. 2 · Eq. 3 of a simulated pose against the reference of the same frame.
/// @param keypoints  may be null
Reward tracking_reward(const RewardWeights& weights, const Pose& reference, const Pose& simulated,
                       const KeypointFrame* keypoints);

}  // namespace mimicx::rl::tracking
