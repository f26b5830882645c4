/// Projection of a keypoint into the picture, with derivatives.  docs/method.md, "Keypoint fit", (6)
#pragma once

#include "fit/least_squares/fit_kinematics.h"

namespace mimicx::fit {

/// Error of a keypoint, in heights of the box, and its derivatives.
struct Projection {
  bool valid = false;                              ///< the point is in front of the camera
  Eigen::Vector2d error;                           ///< (projected − detected) / box + offset
  Eigen::Matrix<double, 2, 3> by_point;            ///< by the position of the point
  Eigen::Matrix<double, 2, kFirstBeta> by_camera;  ///< by tilt, focal length and lead
};

/// @param k    index of the keypoint in `FitProblem::points`
/// @param p_W  position of its point in frame t, m
/// @param v_W  its velocity, m per frame
Projection project_point(const FitProblem& problem, const FitState& state, int t, std::size_t k,
                         const Vector3d& p_W, const Vector3d& v_W);

/// First offset of a keypoint among the clip's unknowns.
inline int offset_of(std::size_t k) { return kFirstOffset + kOffsets * static_cast<int>(k); }

/// A keypoint of a frame: its error and the derivatives by all unknowns it depends on.
struct KeypointDerivatives {
  Projection seen;
  Eigen::Matrix<double, 2, kFrameUnknowns> by_frame;
  Eigen::Matrix<double, 2, kFirstOffset> by_clip;  ///< camera, lead and shape
  Eigen::Matrix<double, 2, kOffsets> by_offset;
};

/// World position of a keypoint, m, with its offset on the limb.
Vector3d point_of(const FitProblem& problem, const FitState& state, const FrameKinematics& k,
                  std::size_t point);

/// Error of a keypoint in a frame. @param motion  of the state, [frames]
Projection keypoint_error(const FitProblem& problem, const FitState& state,
                          const PerFrame<FrameKinematics>& motion, int t, std::size_t k);
/// The same with derivatives by the unknowns.
KeypointDerivatives keypoint_derivatives(const FitProblem& problem, const FitState& state,
                                         const PerFrame<FrameKinematics>& motion, int t, std::size_t k);

}  // namespace mimicx::fit
