#include "pipeline/audit/feasibility.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/units.h"

namespace mimicx::pipeline::audit {
namespace {

constexpr double kFriction = 1.0;
// Weight of the sum of squared forces beside the squared residual: it makes the forces unique and leaves less
// than 1e-4 of the weight as residual.
constexpr double kSmallForces = 1e-4;

using Matrix6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Least squares ‖A x − b‖² + ε‖x‖² over x ≥ 0 by the active-set method; ends because every passive set is
/// left for good once its cost was reached.
Eigen::VectorXd non_negative_least_squares(const Matrix6X& A, const Vector6d& b) {
  const Eigen::Index n = A.cols();
  Eigen::MatrixXd gram = A.transpose() * A;
  gram.diagonal().array() += kSmallForces;
  const Eigen::VectorXd right = A.transpose() * b;
  const double tolerance = 1e-9 * (1.0 + right.cwiseAbs().maxCoeff());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Index> passive;
  const auto solved = [&] {
    Eigen::VectorXd z = Eigen::VectorXd::Zero(n);
    const Eigen::MatrixXd gram_passive = gram(passive, passive);
    const Eigen::VectorXd right_passive = right(passive);
    z(passive) = Eigen::VectorXd(gram_passive.ldlt().solve(right_passive));
    return z;
  };
  for (Eigen::Index iteration = 0; iteration < 10 * n; ++iteration) {
    Eigen::VectorXd slope = right - gram * x;
    for (Eigen::Index i : passive) slope[i] = 0.0;
    Eigen::Index best = 0;
    if (slope.maxCoeff(&best) <= tolerance) break;
    passive.push_back(best);
    Eigen::VectorXd z = solved();
    while (!passive.empty() && z(passive).minCoeff() <= 0.0) {
      double part = 1.0;  // of the way to z before the first force would pull
      for (Eigen::Index i : passive)
        if (z[i] <= 0.0) part = std::min(part, x[i] / std::max(x[i] - z[i], 1e-300));
      x += part * (z - x);
      std::erase_if(passive, [&](Eigen::Index i) { return z[i] <= 0.0 && x[i] <= 1e-9; });
      for (Eigen::Index i = 0; i < n; ++i)
        if (std::find(passive.begin(), passive.end(), i) == passive.end()) x[i] = 0.0;
      z = solved();
    }
    x = z;
  }
  return x;
}

/// What moves a body: force at its centre of mass and moment about it, gravity taken off.
struct BodyLoad {
  Vector3d p_com, force, moment;
};

PerBody<BodyLoad> body_loads(const Character& c, const std::vector<BodyPoses>& poses, std::size_t t,
                             double fps) {
  PerBody<BodyLoad> loads;
  for (std::size_t b = 0; b < kBodies; ++b) {
    const auto center = [&](std::size_t i) {
      return Vector3d(poses[i].p_WB[b] + poses[i].q_WB[b] * c.com_B[b]);
    };
    const auto spin = [&](std::size_t i, std::size_t j) {  // angular momentum between two frames
      const Quaterniond &q_i = poses[i].q_WB[b], &q_j = poses[j].q_WB[b];
      const Vector3d turn_B = log_map(q_i.conjugate() * q_j);
      return Vector3d(q_i * (exp_map(0.5 * turn_B) * (c.inertia_B[b] * (fps * turn_B))));
    };
    const Vector3d acceleration = fps * fps * (center(t + 1) - 2.0 * center(t) + center(t - 1));
    loads[b].p_com = center(t);
    loads[b].force = c.mass[b] * (acceleration + kGravity * Vector3d::UnitZ());
    loads[b].moment = fps * (spin(t, t + 1) - spin(t - 1, t));
  }
  return loads;
}

/// A point of a foot on the floor and the force on it.
struct Touch {
  int body;
  Vector3d p, force;
};

List<Touch> touching_points(const Character& c, const BodyPoses& poses, const Touching& touching) {
  const std::size_t count = touching.whole_body ? c.contact_points.size() : kFootPoints;
  List<Touch> touches;
  for (std::size_t i = 0; i < count; ++i) {
    const ContactPoint& point = c.contact_points[i];
    const Vector3d p = lowest_position(point, poses);
    if (p.z() <= touching.height && p.z() >= -touching.depth)
      touches.push_back({point.body, p, Vector3d::Zero()});
  }
  return touches;
}

/// Forces at `touches` that come nearest to `wanted` = (moment about `center`; force).
/// @return what is left of it
Vector6d share_out(const Vector3d& center, const Vector6d& wanted, List<Touch>& touches) {
  if (touches.empty()) return wanted;
  constexpr Eigen::Index kEdges = 4;
  const auto edge = [](Eigen::Index k) {
    const double angle = 0.5 * M_PI * static_cast<double>(k);
    return Vector3d(kFriction * std::cos(angle), kFriction * std::sin(angle), 1.0);
  };
  Matrix6X A(6, kEdges * static_cast<Eigen::Index>(touches.size()));
  for (Eigen::Index i = 0; i < A.cols(); ++i) {
    const Vector3d arm = touches[i / kEdges].p - center;
    const Vector3d force = edge(i % kEdges), moment = arm.cross(force);
    for (Eigen::Index k = 0; k < 3; ++k) {
      A(k, i) = moment[k];
      A(3 + k, i) = force[k];
    }
  }
  const Eigen::VectorXd x = non_negative_least_squares(A, wanted);
  for (Eigen::Index i = 0; i < A.cols(); ++i) touches[i / kEdges].force += x[i] * edge(i % kEdges);
  return wanted - A * x;
}

FrameDemand demand_of(const Character& c, const std::vector<BodyPoses>& poses, std::size_t t, double fps,
                      const Touching& touching) {
  const PerBody<BodyLoad> loads = body_loads(c, poses, t, fps);
  Vector3d center = Vector3d::Zero();
  for (std::size_t b = 0; b < kBodies; ++b) center += c.mass[b] * loads[b].p_com / c.total_mass();
  Vector6d wanted = Vector6d::Zero();
  for (const BodyLoad& load : loads) {
    wanted.head<3>() += load.moment + (load.p_com - center).cross(load.force);
    wanted.tail<3>() += load.force;
  }
  List<Touch> touches = touching_points(c, poses[t], touching);
  const Vector6d left = share_out(center, wanted, touches);
  FrameDemand demand;
  demand.residual_moment = left.head<3>();
  demand.residual_force = left.tail<3>();
  // Force and moment about the joint that a body and those beyond it need from their parent.
  PerBody<Vector3d> force, torque;
  for (std::size_t b = 0; b < kBodies; ++b) {
    force[b] = loads[b].force;
    torque[b] = loads[b].moment + (loads[b].p_com - poses[t].p_WB[b]).cross(loads[b].force);
  }
  for (const Touch& touch : touches) {
    force[touch.body] -= touch.force;
    torque[touch.body] -= (touch.p - poses[t].p_WB[touch.body]).cross(touch.force);
  }
  for (int b = kBodies - 1; b > 0; --b) {
    const int parent = kParents[b];
    force[parent] += force[b];
    torque[parent] += torque[b] + (poses[t].p_WB[b] - poses[t].p_WB[parent]).cross(force[b]);
  }
  demand.torque = torque;
  demand.torque[kPelvis].setZero();  // no joint: what is left there is the residual
  return demand;
}

}  // namespace

std::vector<FrameDemand> motion_demands(const motion::Clip& clip, const Touching& touching) {
  if (clip.frames() < 3) throw std::invalid_argument("motion_demands: at least 3 frames are needed");
  if (clip.body_model != "mimicx")
    throw std::invalid_argument("motion_demands: the body model must be 'mimicx'");
  const Character character = make_character(clip.betas);
  const std::vector<BodyPoses> poses = motion::poses_of(clip);
  std::vector<FrameDemand> demands;
  for (std::size_t t = 1; t + 1 < poses.size(); ++t)
    demands.push_back(demand_of(character, poses, t, clip.fps, touching));
  return demands;
}

PerBody<double> torque_ratios(const Character& character, const BodyPoses& poses, const FrameDemand& demand) {
  PerBody<double> ratios{};
  for (int b = 1; b < kBodies; ++b) {
    const double torque =
        is_hinge(b) ? std::abs(demand.torque[b].dot(poses.q_WB[b] * hinge_axis(b))) : demand.torque[b].norm();
    ratios[b] = torque / character.joint[b].torque_limit;
  }
  return ratios;
}

Feasibility feasibility(const motion::Clip& clip) {
  const std::vector<FrameDemand> demands = motion_demands(clip);
  const Character character = make_character(clip.betas);
  const std::vector<BodyPoses> poses = motion::poses_of(clip);
  const double weight = kGravity * character.total_mass(), n = static_cast<double>(demands.size());
  Feasibility summary;
  for (std::size_t i = 0; i < demands.size(); ++i) {
    const double force = demands[i].residual_force.norm() / weight,
                 moment = demands[i].residual_moment.norm() / weight;
    summary.mean_force += force / n;
    summary.mean_moment += moment / n;
    summary.max_force = std::max(summary.max_force, force);
    summary.max_moment = std::max(summary.max_moment, moment);
    const PerBody<double> ratios = torque_ratios(character, poses[i + 1], demands[i]);
    const auto worst = std::max_element(ratios.begin(), ratios.end());
    if (*worst > 1.0) ++summary.frames_over_limit;
    if (*worst <= summary.worst_torque) continue;
    summary.worst_torque = *worst;
    summary.worst_joint = static_cast<int>(worst - ratios.begin());
  }
  return summary;
}

}  // namespace mimicx::pipeline::audit
