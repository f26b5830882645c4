/// Where the camera of the keypoint fit sees a joint, with derivatives.  docs/method.md, "Keypoint fit", (6)
#pragma once

#include "motion/fit/problem.h"

namespace mimicx::motion::fit {

/// Error of a keypoint, in heights of the box, and its derivatives.
struct Projection {
  bool valid = false;                    ///< in front of the camera
  Eigen::Vector2d error;                 ///< (projected − detected) / box + offset
  Eigen::Matrix<double, 2, 3> by_point;  ///< by the position of the joint
  Eigen::Vector2d by_tilt, by_focal;
};

/// @param k    index of the keypoint in `FitProblem::points`
/// @param p_W  position of its joint in frame t, m
Projection project_point(const FitProblem& problem, const FitState& state, int t, std::size_t k,
                         const Vector3d& p_W);

}  // namespace mimicx::motion::fit
