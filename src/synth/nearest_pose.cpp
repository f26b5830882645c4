#include "synth/nearest_pose.h"

#include <Eigen/Dense>
#include <algorithm>

#include "core/elementary.h"

namespace mimicx::synth {
namespace {

constexpr int kUnknowns = 6 + kDofs;
// Weights, in units of a joint's angle in rad.
constexpr double kPelvisTurn = 3.0;   // per rad
constexpr double kRootPlace = 0.05;   // per m
constexpr double kPoint = 1000.0;     // per m, of its place or under the floor
constexpr double kBalance = 20.0;     // per m
constexpr double kLongestStep = 0.4;  // rad or m in one iteration
constexpr double kConverged = 1e-9;   // rad or m
constexpr int kIterations = 40, kHalvings = 8;

using Row = Eigen::Matrix<double, kUnknowns, 1>;
using Jacobian = Eigen::Matrix<double, 3, kUnknowns>;

/// First unknown of a body's turn, in the body's own frame; 0 to 2 are the root's place.
constexpr int turn_of(int body) { return body == kPelvis ? 3 : 6 + first_dof(body); }
bool turns_about_hinge(int body) { return body != kPelvis && is_hinge(body); }

/// A sum of squares (w (r + gᵀδ))².
class Squares {
 public:
  void add(double weight, double residual, const Row& gradient) {
    rows_.row(count_) = weight * gradient.transpose();
    right_[count_++] = -weight * residual;
  }
  void add(double weight, double residual, int unknown) {
    diagonal_[unknown] += square(weight);
    single_[unknown] -= square(weight) * residual;
  }
  /// The δ that makes it smallest.
  Row solution() const {
    const auto rows = rows_.topRows(count_);
    Eigen::Matrix<double, kUnknowns, kUnknowns> A = rows.transpose() * rows;
    A.diagonal() += diagonal_;
    return A.llt().solve(rows.transpose() * right_.head(count_) + single_);
  }

 private:
  static constexpr int kMostRows = 3 * 64 + 2;  ///< three per contact point, two of the centre of mass
  Eigen::Matrix<double, kMostRows, kUnknowns> rows_;
  Eigen::Matrix<double, kMostRows, 1> right_;
  Row diagonal_ = Row::Zero(), single_ = Row::Zero();
  int count_ = 0;
};

/// d p / d unknowns of a point of `body`.
Jacobian point_jacobian(const BodyPoses& poses, int body, const Vector3d& p) {
  Jacobian J = Jacobian::Zero();
  J.leftCols<3>().setIdentity();
  for (int j = body; j >= 0; j = kParents[j]) {
    const Matrix3d R = poses.q_WB[j].toRotationMatrix();
    const Vector3d arm = p - poses.p_WB[j];
    if (turns_about_hinge(j))
      J.col(turn_of(j)) = (R * hinge_axis(j)).cross(arm);
    else
      for (int k = 0; k < 3; ++k) J.col(turn_of(j) + k) = R.col(k).cross(arm);
  }
  return J;
}

void add_posture(const SynthPose& nominal, const SynthPose& pose, Squares& squares) {
  for (int k = 0; k < 3; ++k) squares.add(kRootPlace, pose.p_root[k] - nominal.p_root[k], k);
  for (int b = 0; b < kBodies; ++b) {
    const Vector3d off = log_map(nominal.q[b].conjugate() * pose.q[b]);
    if (turns_about_hinge(b))
      squares.add(1.0, off.dot(hinge_axis(b)), turn_of(b));
    else
      for (int k = 0; k < 3; ++k) squares.add(b == kPelvis ? kPelvisTurn : 1.0, off[k], turn_of(b) + k);
  }
}

void add_points(const Character& c, const PoseTargets& wanted, const BodyPoses& poses, Squares& squares) {
  for (int i = 0; i < c.contact_points.count(); ++i) {
    const Vector3d p = lowest_position(c.contact_points[i], poses);
    const auto& target = wanted.point[i];
    if (!target && p.z() >= 0.0) continue;
    const Jacobian J = point_jacobian(poses, c.contact_points[i].body, p);
    const Vector3d off = target ? Vector3d(p - target->place) : p;
    for (int k = target && !target->anywhere ? 0 : 2; k < 3; ++k) squares.add(kPoint, off[k], J.row(k));
  }
}

void add_balance(const Character& c, const Eigen::Vector2d& wanted, const BodyPoses& poses,
                 Squares& squares) {
  Jacobian J = Jacobian::Zero();
  for (int b = 0; b < kBodies; ++b)
    J += c.mass[b] / c.total_mass() * point_jacobian(poses, b, poses.p_WB[b] + poses.q_WB[b] * c.com_B[b]);
  const Vector3d com = center_of_mass(c, poses);
  for (int k = 0; k < 2; ++k) squares.add(kBalance, com[k] - wanted[k], J.row(k));
}

/// What Squares linearise.
double cost(const Character& c, const PoseTargets& wanted, const SynthPose& pose) {
  const BodyPoses poses = forward_kinematics(c, pose.p_root, pose.q);
  double sum = square(kRootPlace) * (pose.p_root - wanted.nominal.p_root).squaredNorm();
  for (int b = 0; b < kBodies; ++b)
    sum += square(b == kPelvis ? kPelvisTurn : 1.0) *
           log_map(wanted.nominal.q[b].conjugate() * pose.q[b]).squaredNorm();
  for (int i = 0; i < c.contact_points.count(); ++i) {
    const Vector3d p = lowest_position(c.contact_points[i], poses);
    const auto& target = wanted.point[i];
    if (target && !target->anywhere)
      sum += square(kPoint) * (p - target->place).squaredNorm();
    else
      sum += square(kPoint * (target ? p.z() - target->place.z() : std::min(p.z(), 0.0)));
  }
  return sum + square(kBalance) * (center_of_mass(c, poses).head<2>() - wanted.com).squaredNorm();
}

SynthPose stepped(SynthPose pose, const Row& step) {
  pose.p_root += step.head<3>();
  for (int b = 0; b < kBodies; ++b) {
    const Vector3d turn = turns_about_hinge(b) ? Vector3d(step[turn_of(b)] * hinge_axis(b))
                                               : Vector3d(step.segment<3>(turn_of(b)));
    pose.q[b] = (pose.q[b] * exp_map(turn)).normalized();
  }
  return pose;
}

}  // namespace

SynthPose nearest_pose(const Character& character, const PoseTargets& wanted, const SynthPose& start) {
  SynthPose pose = start;
  double costs = cost(character, wanted, pose), length = 1.0;
  for (int iteration = 0; iteration < kIterations && length > kConverged; ++iteration) {
    const BodyPoses poses = forward_kinematics(character, pose.p_root, pose.q);
    Squares squares;
    add_posture(wanted.nominal, pose, squares);
    add_points(character, wanted, poses, squares);
    add_balance(character, wanted.com, poses, squares);
    Row step = squares.solution();
    step *= std::min(1.0, kLongestStep / step.cwiseAbs().maxCoeff());
    // Points that come to the floor or leave it make full steps go to and fro.
    for (int halving = 0; halving < kHalvings; ++halving, step *= 0.5) {
      length = step.cwiseAbs().maxCoeff();
      const SynthPose next = stepped(pose, step);
      const double next_costs = cost(character, wanted, next);
      if (next_costs >= costs && halving + 1 < kHalvings) continue;
      pose = next;
      costs = next_costs;
      break;
    }
  }
  pose.p_com = center_of_mass(character, forward_kinematics(character, pose.p_root, pose.q));
  return pose;
}

}  // namespace mimicx::synth
