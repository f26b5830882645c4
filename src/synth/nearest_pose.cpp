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

/// Calls visit(weight, residual, add) for every residual of a pose; add(squares) adds it to a sum of squares.
template <class Visit>
void for_each_residual(const Character& c, const PoseTargets& wanted, const SynthPose& pose,
                       const BodyPoses& poses, const Visit& visit) {
  const Vector3d place = pose.p_root - wanted.nominal.p_root;
  visit(kRootPlace, place, [&](Squares& squares) {
    for (int k = 0; k < 3; ++k) squares.add(kRootPlace, place[k], k);
  });
  for (int b = 0; b < kBodies; ++b) {
    const double weight = b == kPelvis ? kPelvisTurn : 1.0;
    const Vector3d off = log_map(wanted.nominal.q[b].conjugate() * pose.q[b]);
    visit(weight, off, [&](Squares& squares) {
      if (turns_about_hinge(b))
        squares.add(weight, off.dot(hinge_axis(b)), turn_of(b));
      else
        for (int k = 0; k < 3; ++k) squares.add(weight, off[k], turn_of(b) + k);
    });
  }
  for (int i = 0; i < c.contact_points.count(); ++i) {
    const Vector3d p = lowest_position(c.contact_points[i], poses);
    const auto& target = wanted.point[i];
    const double over_ground = p.z() - wanted.scene.height_under(p);
    if (!target && over_ground >= 0.0) continue;
    const Vector3d off = target ? Vector3d(p - target->place) : Vector3d(p.x(), p.y(), over_ground);
    const auto add = [&](Squares& squares, int first) {
      const Jacobian J = point_jacobian(poses, c.contact_points[i].body, p);
      for (int k = first; k < 3; ++k) squares.add(kPoint, off[k], J.row(k));
    };
    if (target && !target->anywhere)
      visit(kPoint, off, [&](Squares& squares) { add(squares, 0); });
    else
      visit(kPoint, off.z(), [&](Squares& squares) { add(squares, 2); });
  }
  const Eigen::Vector2d balance = center_of_mass(c, poses).head<2>() - wanted.com;
  visit(kBalance, balance, [&](Squares& squares) {
    Jacobian J = Jacobian::Zero();
    for (int b = 0; b < kBodies; ++b)
      J += c.mass[b] / c.total_mass() * point_jacobian(poses, b, poses.p_WB[b] + poses.q_WB[b] * c.com_B[b]);
    for (int k = 0; k < 2; ++k) squares.add(kBalance, balance[k], J.row(k));
  });
}

double squared(double weight, double residual) { return square(weight * residual); }
template <class Residual>
double squared(double weight, const Residual& residual) {
  return square(weight) * residual.squaredNorm();
}

double cost(const Character& c, const PoseTargets& wanted, const SynthPose& pose) {
  double sum = 0.0;
  for_each_residual(
      c, wanted, pose, forward_kinematics(c, pose.p_root, pose.q),
      [&](double weight, const auto& residual, const auto&) { sum += squared(weight, residual); });
  return sum;
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
    for_each_residual(character, wanted, pose, poses,
                      [&](double, const auto&, const auto& add) { add(squares); });
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
