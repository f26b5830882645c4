/// The parts of the keypoint fit: unknowns, kinematics with derivatives, terms, labels, contacts. Shared by
/// the fit's files and tests; everyone else includes fit.h.
///
/// Derivatives. c moves a rotation q·exp(c) in its own frame by Jr(c)·δc (right Jacobian of SO(3)), hence in
/// the world by M·δc with M = R_WB·Jr(c); a point p on the body or its descendants moves by
/// (M·δc) × (p − p_joint). A hinge has one column, its axis in the world.
#pragma once

#include "motion/fit/fit.h"
#include "motion/fit/solver.h"
#include "motion/surface.h"

namespace mimicx {

/// Unknowns of a frame: root position (world, m), root rotation, joints as in `first_dof`.
inline constexpr int kRootRotation = 3, kFirstJoint = 6, kFrameUnknowns = kFirstJoint + kDofs;
/// Unknowns of the clip: tilt (rad), log of the focal length's scale, change of β, keypoint offsets (2 each,
/// heights of the box).
enum GlobalUnknown : int { kTilt, kLogFocal, kFirstBeta, kFirstOffset = kFirstBeta + kBetas };

using FrameVector = Eigen::Matrix<double, kFrameUnknowns, 1>;
using PointJacobian = Eigen::Matrix<double, 3, kFrameUnknowns>;
using ShapeJacobian = Eigen::Matrix<double, 3, kBetas>;
using FootPositions = std::array<Vector3d, kFootPoints>;  ///< of the points of the soles, world, m
using Eigen::VectorXd;

struct FitState {
  std::vector<FrameVector> c;  ///< [frames] corrections
  VectorXd g;                  ///< unknowns of the clip
};

/// A detection that the fit uses.
struct FitPoint {
  int body = 0;
  std::size_t column = 0;  ///< in the clip's keypoints
  std::size_t mirror = 0;  ///< index of the other side's point of the same limb; itself where there is none
};

/// The input as the fit sees it, and what does not change while it runs.
struct FitProblem {
  FitOptions options;
  double fps = 30.0;
  std::array<double, kBetas> betas{};  ///< told
  double beta_sigma = 0.0;
  std::optional<RestJoints> rest_joints;    ///< of the clip; its shape is known and stays
  std::vector<Vector3d> p_root;             ///< [frames] of the input, m
  std::vector<PerBody<Quaterniond>> q;      ///< [frames] of the input, knees and elbows hinges
  PerBody<ShapeJacobian> offset_by_beta;    ///< of Character::joint_offset (affine in β)
  std::vector<ShapeJacobian> foot_by_beta;  ///< [kFootPoints] of the foot points' p_B
  std::vector<FitPoint> points;             ///< [K]
  std::vector<std::vector<Vector3d>> uvc;   ///< [frames][K] pixels and confidence, left and right as of now
  std::vector<double> box;                  ///< [frames] height of the person in the picture, px
  Matrix3d intrinsics = Matrix3d::Identity();
  std::vector<Eigen::Matrix4d> extrinsics;  ///< one, or one per frame
  double rotation_jitter = 0.0;             ///< white part of the input's joint rotations, rad per axis
  double position_jitter = 0.0;             ///< of its root position, m per axis

  int frames() const { return static_cast<int>(q.size()); }
  int globals() const { return kFirstOffset + 2 * static_cast<int>(points.size()); }
  const Eigen::Matrix4d& camera(std::size_t t) const { return extrinsics[extrinsics.size() > 1 ? t : 0]; }
};

/// @return a problem without points where the clip has no usable keypoints
FitProblem make_problem(const Clip& clip, const FitOptions& options);
/// No correction.
FitState initial_state(const FitProblem& problem);
/// The character of the fitted shape.
Character character_of(const FitProblem& problem, const FitState& state);
PerBody<Quaterniond> rotations_of(const FitProblem& problem, const FitState& state, std::size_t t);

/// Poses of a frame with what their derivatives need.
struct FrameKinematics {
  BodyPoses poses;
  PerBody<Matrix3d> R;             ///< R_WB
  PerBody<Matrix3d> M;             ///< joint's correction → rotation in the world; a hinge: column 0
  PerBody<ShapeJacobian> by_beta;  ///< of the joint positions
};
FrameKinematics kinematics(const FitProblem& problem, const FitState& state, const Character& character,
                           std::size_t t);
/// Derivative of a point p (world, m) fixed to a body.
PointJacobian point_jacobian(const FrameKinematics& k, int body, const Vector3d& p);

/// Where a keypoint should be seen, in heights of the box, and its derivatives.
struct Projection {
  bool valid = false;                    ///< in front of the camera
  Eigen::Vector2d error;                 ///< (projected + offset − detected) / box
  Eigen::Matrix<double, 2, 3> by_point;  ///< by the position of the joint
  Eigen::Vector2d by_tilt, by_focal;
};
Projection project_point(const FitProblem& problem, const FitState& state, std::size_t t, std::size_t k,
                         const Vector3d& p_W);

/// Body of a foot point, in the order of Character::contact_points.
int foot_body(std::size_t point);

/// Which foot points stand in which frame: [frames][kFootPoints]. @param settled  the motion is on the floor
/// already (contacts by height over z = 0), else by height over each foot's own low percentile
using Contacts = std::vector<std::array<bool, kFootPoints>>;
Contacts find_contacts(const std::vector<FootPositions>& feet, double fps, bool settled);

/// Puts left and right of arms and legs in order, where the prediction strongly prefers it.
/// @param predicted  [frames][K] pixels @return frames in which a limb differs from the file
int order_labels(const std::vector<std::vector<Vector3d>>& detected,
                 const std::vector<std::vector<Eigen::Vector2d>>& predicted, FitProblem& problem);

/// Normal equations of all terms at a state (left: half the Hessian; right: minus half the gradient).
BorderedBand linearise(const FitProblem& problem, const FitState& state,
                       const std::vector<FrameKinematics>& motion, const std::vector<FootPositions>& feet,
                       const Contacts& contacts);

}  // namespace mimicx
