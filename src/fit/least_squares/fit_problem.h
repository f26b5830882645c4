/// The least-squares problem of the fit: its unknowns and its input.
///
/// What it does not do: no kinematics (fit_kinematics.h, projection.h), no cost (fit_terms.h), no solution
/// (keypoint_fit.h).
#pragma once

#include <optional>

#include "fit/fit_config.h"
#include "motion/clip.h"

namespace mimicx::fit {

/// Unknowns of a frame: root position (world, m), root rotation, joints as in `first_dof`.
inline constexpr int kRootRotation = 3, kFirstJoint = 6, kFrameUnknowns = kFirstJoint + kDofs;
/// Unknowns of the clip: tilt (rad), logarithm of the focal length's scale, time by which the keypoints are
/// ahead of the motion (frames), change of β, and five per keypoint: its offset in the picture (heights of
/// the box) and on its limb (body's frame, m).
enum GlobalUnknown : int { kTilt, kLogFocal, kLead, kFirstBeta, kFirstOffset = kFirstBeta + kBetas };
inline constexpr int kFlatOffset = 2, kOffsets = 5;  ///< offsets in the picture; all offsets of a keypoint

using FrameVector = Eigen::Matrix<double, kFrameUnknowns, 1>;
using ShapeJacobian = Eigen::Matrix<double, 3, kBetas>;
using Eigen::VectorXd;

struct FitState {
  PerFrame<FrameVector> c;  ///< [frames] corrections
  VectorXd g;               ///< unknowns of the clip
};

inline constexpr double kReferenceFps = 30.0;  ///< frame rate to which the settings' rates refer

/// Assumed errors of the detections.  docs/method.md, "Keypoint fit", "Levels"
struct FitLevels {
  std::vector<double> keypoint;   ///< [K] σ of a detection of confidence 1, heights of the box
  double confidence_power = 0.0;  ///< σ of a detection grows with confidence to the minus this power
};

/// A keypoint that the fit uses.
struct FitPoint {
  int body = 0;
  std::size_t column = 0;  ///< in the clip's keypoints
  std::size_t mirror = 0;  ///< index of the other side's point of the same limb; itself where there is none
  Vector3d p_B = Vector3d::Zero();                ///< where on its body, m: 0 for a joint
  ShapeJacobian by_beta = ShapeJacobian::Zero();  ///< of p_B
};

/// A point of a sole (`sole_point`), in the order of Character::contact_points.
struct FitFootPoint {
  int body = 0;
  ShapeJacobian by_beta;  ///< of its place in the body's frame
};

/// The input of the fit and its settings. Only `levels`, `settled`, the place of `scene` and the sides in
/// `uvc` change while it runs.
struct FitProblem {
  FitConfig config;
  FitLevels levels;
  bool poses_alone = false;  ///< pose fit: no detections, the input is on the floor, balance has a cost
  bool penalises_acceleration = true;  ///< accelerations have a cost
  bool settled = false;  ///< near the solution: kernels follow the levels; before, they are wide
  double fps = 30.0;
  std::array<double, kBetas> betas{};     ///< of the file
  Array<double, kBetas> beta_sigma{};     ///< per entry; 0: the entry is known
  std::optional<RestJoints> rest_joints;  ///< of the clip, where known: the shape does not change then
  Scene scene;                            ///< the ground
  PerFrame<Vector3d> p_root;              ///< [frames] of the input, m
  PerFrame<PerBody<Quaterniond>> q;       ///< [frames] of the input, knees and elbows hinges
  PerBody<JointParameters> joint;         ///< their ranges
  PerBody<ShapeJacobian> offset_by_beta;  ///< of Character::joint_offset (affine in β)
  Array<FitFootPoint, kFootPoints> foot_points;
  std::vector<FitPoint> points;         ///< [K]
  PerFrame<std::vector<Vector3d>> uvc;  ///< [frames][K] pixels and confidence, left and right corrected
  PerFrame<double> box;                 ///< [frames] height of the person in the picture, px
  Matrix3d intrinsics = Matrix3d::Identity();
  PerFrame<Eigen::Matrix4d> extrinsics;  ///< one, or one per frame
  double rotation_jitter = 0.0;          ///< white noise of the input's joint rotations, rad per axis
  PerBody<double> joint_jitter{};        ///< the same, joint by joint
  double position_jitter = 0.0;          ///< of its root position, m per axis

  int frames() const { return q.count(); }
  int globals() const { return kFirstOffset + kOffsets * static_cast<int>(points.size()); }
};

/// A point nearer to the camera than this is not used, m.
inline constexpr double kClosest = 0.2;

/// @return a problem without points where the clip has no usable keypoints
FitProblem make_problem(const motion::Clip& clip, const FitConfig& config);
/// The state without corrections.
FitState initial_state(const FitProblem& problem);
/// The character of the fitted shape.
Character character_of(const FitProblem& problem, const FitState& state);
/// Joint rotations of a frame, corrected.  docs/method.md, "Keypoint fit", (4)
PerBody<Quaterniond> rotations_of(const FitProblem& problem, const FitState& state, int t);

}  // namespace mimicx::fit
