/// Detected keypoints of a clip, frame by frame, and their error against projected bodies, for the reward.
#pragma once

#include "character/bodies.h"
#include "motion/clip.h"

namespace mimicx::rl::tracking {

/// Detected keypoints of one frame, matched to bodies.
struct KeypointFrame {
  struct Detection {
    int body;
    double u, v, weight;  ///< pixels; confidence
  };
  std::vector<Detection> detections;       ///< of positive confidence only
  Eigen::Matrix<double, 3, 4> projection;  ///< K [R t]: world → homogeneous pixels
  double box_height = 0;                   ///< of the detected person, pixels
};

/// Matches keypoints to bodies by name (22 SMPL-X joints or COCO-17; eyes, ears and nose are ignored). A
/// frame without detections is empty; the list is empty without keypoints.
List<KeypointFrame> match_keypoints(const motion::Keypoints& keypoints);

/// Error of Eq. 3: mean squared pixel error in units of the box height, weighted by confidence. Detections
/// whose body is behind the camera are ignored; 0 if none is left.
/// @param p_WB  of the simulated character, m
double projection_error(const KeypointFrame& keypoints, const PerBody<Vector3d>& p_WB);

}  // namespace mimicx::rl::tracking
