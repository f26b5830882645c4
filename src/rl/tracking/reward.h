/// The reward of the tracking task: Eq. 2 times Eq. 3.                      METHOD: docs/method.md §5
///
/// Every factor is exp(−w · error) in (0, 1]. Errors are means over joints, so that the weights do not
/// depend on their number; rotations differ by the geodesic angle; the third velocity term of Eq. 2 is read
/// as the difference of the joints' angular velocities. Where there are no keypoints Eq. 3 is exactly 1.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "motion/clip.h"
#include "rl/tracking/state.h"

namespace mimicx::rl {

/// Defaults: docs/method.md §12 and docs/experiments.md.
struct RewardWeights {
  double root_position = 100.0;  ///< 1/m²
  double root_rotation = 8.0;    ///< 1/rad²
  double pose = 20.0;            ///< 1/rad², mean over the 21 joints
  double velocity = 0.05;        ///< s²/rad², mean over the 21 joints
  double end_effector = 40.0;    ///< 1/m², mean over hands and feet
  double projection = 100.0;     ///< per (box height)², confidence-weighted mean over the keypoints
};

inline constexpr int kRewardTerms = 6;
inline constexpr std::array<std::string_view, kRewardTerms> kRewardTermNames = {
    "root_position", "root_rotation", "pose", "velocity", "end_effector", "projection"};

struct Reward {
  double total = 0;                         ///< product of the terms
  std::array<double, kRewardTerms> term{};  ///< order of kRewardTermNames
};

/// Detected keypoints of one frame, matched to bodies and ready to compare with a projection.
struct KeypointFrame {
  struct Detection {
    int body;
    double u, v, weight;  ///< pixels; confidence
  };
  std::vector<Detection> detections;       ///< of positive confidence only
  Eigen::Matrix<double, 3, 4> projection;  ///< K [R t]: world → homogeneous pixels
  double box_height = 0;                   ///< of the detected person, pixels
};

/// Joins the names of `keypoints` to bodies by name (22 SMPL-X joints or COCO-17; eyes, ears and nose
/// unused). Empty frames where nothing is detected. An empty vector when there are no keypoints.
std::vector<KeypointFrame> match_keypoints(const Keypoints& keypoints);

/// Eq. 2 · Eq. 3 of a simulated pose against the reference of the same frame.
/// @param keypoints  may be null
Reward tracking_reward(const RewardWeights& weights, const Pose& reference, const Pose& simulated,
                       const KeypointFrame* keypoints);

}  // namespace mimicx::rl
