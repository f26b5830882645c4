/// The keypoint fit as a problem: its unknowns, and the input as it sees it.
///
/// What it does not do: no kinematics (kinematics.h, projection.h), no cost (terms.h), no solution (fit.h).
#pragma once

#include <optional>

#include "motion/clip.h"
#include "motion/fit/config.h"

namespace mimicx::motion::fit {

/// Unknowns of a frame: root position (world, m), root rotation, joints as in `first_dof`.
inline constexpr int kRootRotation = 3, kFirstJoint = 6, kFrameUnknowns = kFirstJoint + kDofs;
/// Unknowns of the clip: tilt (rad), log of the focal length's scale, change of β, keypoint offsets (2 each,
/// heights of the box).
enum GlobalUnknown : int { kTilt, kLogFocal, kFirstBeta, kFirstOffset = kFirstBeta + kBetas };

using FrameVector = Eigen::Matrix<double, kFrameUnknowns, 1>;
using ShapeJacobian = Eigen::Matrix<double, 3, kBetas>;
using Eigen::VectorXd;

struct FitState {
  PerFrame<FrameVector> c;  ///< [frames] corrections
  VectorXd g;               ///< unknowns of the clip
};

/// A detection that the fit uses.
struct FitPoint {
  int body = 0;
  std::size_t column = 0;  ///< in the clip's keypoints
  std::size_t mirror = 0;  ///< index of the other side's point of the same limb; itself where there is none
};

/// A point of a sole (`sole_point`), in the order of Character::contact_points.
struct FitFootPoint {
  int body = 0;
  ShapeJacobian by_beta;  ///< of its place in the body's frame
};

/// The input as the fit sees it, and what does not change while it runs.
struct FitProblem {
  FitConfig config;
  double fps = 30.0;
  std::array<double, kBetas> betas{};  ///< as the file says
  double beta_sigma = 0.0;
  std::optional<RestJoints> rest_joints;  ///< of the clip; its shape is known and stays
  PerFrame<Vector3d> p_root;              ///< [frames] of the input, m
  PerFrame<PerBody<Quaterniond>> q;       ///< [frames] of the input, knees and elbows hinges
  PerBody<ShapeJacobian> offset_by_beta;  ///< of Character::joint_offset (affine in β)
  Array<FitFootPoint, kFootPoints> foot_points;
  std::vector<FitPoint> points;         ///< [K]
  PerFrame<std::vector<Vector3d>> uvc;  ///< [frames][K] pixels and confidence, left and right as of now
  PerFrame<double> box;                 ///< [frames] height of the person in the picture, px
  Matrix3d intrinsics = Matrix3d::Identity();
  PerFrame<Eigen::Matrix4d> extrinsics;  ///< one, or one per frame
  double rotation_jitter = 0.0;          ///< white part of the input's joint rotations, rad per axis
  double position_jitter = 0.0;          ///< of its root position, m per axis

  int frames() const { return q.count(); }
  int globals() const { return kFirstOffset + 2 * static_cast<int>(points.size()); }
  const Eigen::Matrix4d& camera(int t) const { return extrinsics[extrinsics.count() > 1 ? t : 0]; }
};

/// Distance in front of the camera from which on a point is seen, m.
inline constexpr double kClosest = 0.2;

/// @return a problem without points where the clip has no usable keypoints
FitProblem make_problem(const Clip& clip, const FitConfig& config);
/// No correction.
FitState initial_state(const FitProblem& problem);
/// The character of the fitted shape.
Character character_of(const FitProblem& problem, const FitState& state);
/// Joint rotations of a frame, corrected.  docs/method.md, "Keypoint fit", (4)
PerBody<Quaterniond> rotations_of(const FitProblem& problem, const FitState& state, int t);

}  // namespace mimicx::motion::fit
