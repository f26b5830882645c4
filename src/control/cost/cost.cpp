#include "control/cost/cost.h"

#include <cmath>
#include <memory>
#include <stdexcept>

#include "control/cost/centroidal_momentum.h"
#include "control/cost/legs_in_boxes.h"
#include "control/cost/sole_slip.h"
#include "core/error.h"

namespace mimicx::control {
namespace {

/// d p_WB / d (pose coordinates): [66][61], three rows per body.
Eigen::MatrixXd position_jacobian(const BodyPoses& poses) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3 * kBodies, kPositions);
  for (int i = 0; i < kBodies; ++i) {
    J.block<3, 3>(3 * i, 0).setIdentity();
    for (int j = kParents[i]; j >= 0; j = kParents[j]) {
      const Vector3d arm = poses.p_WB[i] - poses.p_WB[j];
      const Matrix3d R = poses.q_WB[j].toRotationMatrix();
      if (is_hinge(j)) {
        J.block<3, 1>(3 * i, kJointRotation + first_dof(j)) = (R * hinge_axis(j)).cross(arm);
        continue;
      }
      const int column = j == 0 ? kRootRotation : kJointRotation + first_dof(j);
      for (int axis = 0; axis < 3; ++axis) J.block<3, 1>(3 * i, column + axis) = R.col(axis).cross(arm);
    }
  }
  return J;
}

bool is_foot(std::size_t i) {
  return i == kLeftAnkle || i == kRightAnkle || i == kLeftFoot || i == kRightFoot;
}

void check(const CostWeights& w) {
  const auto bad = [](double value) { return !(value >= 0.0 && std::isfinite(value)); };
  for (double value : {w.position, w.root_rotation, w.joint_rotation, w.root_velocity, w.root_spin,
                       w.joint_velocity, w.com_velocity, w.angular_momentum, w.slip, w.box_sides, w.torque,
                       w.residual, w.change, w.assistance, w.assistance_spin})
    if (bad(value)) raise(std::invalid_argument("weights of the cost must not be negative"));
  for (std::size_t i = 0; i < kBodies; ++i)
    if (bad(w.body_position[i]) || bad(w.body_rotation[i]))
      raise(std::invalid_argument("factors of bodies must not be negative"));
  if (!(w.residual > 0.0)) raise(std::invalid_argument("the weight of residuals must be positive"));
}

Vector6d vector_of(const CentroidalMomentum<double>& momentum) {
  Vector6d out;
  out << to_eigen(momentum.linear), to_eigen(momentum.angular);
  return out;
}

/// Adds the momentum's term, a square of rank six, and those of the legs in the sides of boxes and of the
/// soles.
void add_momentum_and_contact_terms(const System& system, const Cost& cost, int frame, const State<double>& x,
                                    StateQuadratic& out) {
  const auto d = std::make_unique<Data<double>>();
  update_kinematics(system.exact_model, x, *d);
  const auto add = [&](const auto& J, const auto& error, const auto& weight) {
    out.value += error.dot(weight.cwiseProduct(error));
    out.gradient += 2.0 * (J.transpose() * weight.cwiseProduct(error));
    const Eigen::MatrixXd rooted = (2.0 * weight).cwiseSqrt().asDiagonal() * J;
    out.hessian.selfadjointView<Eigen::Lower>().rankUpdate(rooted.transpose());
  };
  Vector6d weight;
  for (int k = 0; k < 6; ++k) weight[k] = cost.momentum_weight(frame, k);
  if (!weight.isZero(0.0))
    add(centroidal_jacobian(system.exact_model, *d),
        Vector6d(vector_of(centroidal_momentum(system.exact_model, *d)) - cost.momentum[frame]), weight);
  if (cost.weights.box_sides > 0.0 && has_sides(system)) {
    const SideDepths sides = side_depths(system, *d);
    const Eigen::Matrix<double, kLegSpheres, 1> each = decltype(each)::Constant(cost.weights.box_sides);
    if (!sides.depth.isZero(0.0)) add(sides.by_tangent, sides.depth, each);
  }
  if (!(cost.weights.slip > 0.0)) return;
  Eigen::Matrix<double, 2 * kFootPoints, 1> slip, slip_weight;
  slip_weight.setConstant(cost.slip_weight());
  const auto slips = sole_slip(system, cost.landings[frame], *d);
  for (int point = 0; point < kFootPoints; ++point)
    slip.segment<2>(2 * point) = to_eigen(slips[point]).head<2>();
  add(sole_slip_jacobian(system, cost.landings[frame], *d), slip, slip_weight);
}

}  // namespace

BodyPoses poses_of(const System& system, const State<double>& x) {
  BodyPoses poses;
  poses.p_WB[0] = to_eigen(x.p_root);
  poses.q_WB[0] = to_eigen(x.q[0]).normalized();
  for (std::size_t i = 1; i < kBodies; ++i) {
    const int parent = kParents[i];
    const Vec3<float>& offset = system.model.joint_offset[i];
    poses.p_WB[i] = poses.p_WB[parent] + poses.q_WB[parent] * Vector3d(offset.x, offset.y, offset.z);
    poses.q_WB[i] = (poses.q_WB[parent] * to_eigen(x.q[i])).normalized();
  }
  return poses;
}

CostWeights::CostWeights() {
  body_rotation.fill(1.0);
  body_rotation[kLeftFoot] = body_rotation[kRightFoot] = 6.0;
  for (std::size_t i = 0; i < kBodies; ++i) body_position[i] = is_foot(i) ? 2.0 : 1.0;
}

double Cost::position_weight(int frame, int body) const {
  return static_cast<double>(factors[frame].certainty[body]) * weights.position * weights.body_position[body];
}

double Cost::tangent_weight(int frame, int k) const {
  if (k < kRootRotation) return 0.0;
  const auto sure = [&](int body) { return static_cast<double>(factors[frame].certainty[body]); };
  if (k < kRootVelocity) {
    const int body = k < kJointRotation ? 0 : dofs()[k - kJointRotation].body;
    return sure(body) * weights.body_rotation[body] *
           (body == 0 ? weights.root_rotation : weights.joint_rotation);
  }
  if (k < kJointVelocity) return sure(0) * (k < kRootSpin ? weights.root_velocity : weights.root_spin);
  return sure(dofs()[k - kJointVelocity].body) * weights.joint_velocity;
}

double Cost::momentum_weight(int frame, int k) const {
  return static_cast<double>(factors[frame].momentum) *
         (k < 3 ? weights.com_velocity : weights.angular_momentum);
}

double Cost::slip_weight() const { return weights.slip / kPointsPerFoot; }

Cost make_cost(const System& system, const CostWeights& weights, List<FrameFactors> factors) {
  check(weights);
  if (factors.empty()) factors.resize(system.reference.size());
  if (factors.size() != system.reference.size())
    raise(std::invalid_argument("factors and reference must have the same number of frames"));
  Cost cost;
  cost.weights = weights;
  cost.factors = std::move(factors);
  for (int k = 0; k < kDofs; ++k) {
    const int body = dofs()[k].body;
    const double kp = system.exact_model.kp[body], per_mass = kp / system.mass;
    cost.elastic[k] = weights.torque * per_mass * per_mass;
    cost.lead[k] = system.exact_model.kd[body] / kp;
  }
  return with_goal(system, cost, system.reference);
}

Cost with_goal(const System& system, const Cost& cost, List<State<double>> goal) {
  if (goal.size() != system.reference.size())
    raise(std::invalid_argument("goal and reference must have the same number of frames"));
  Cost out{cost.weights, std::move(goal), {}, {}, {}, cost.factors, cost.elastic, cost.lead};
  const auto kinematics = std::make_unique<Data<double>>();
  List<SolePlaces> soles;
  for (const State<double>& x : out.goal) {
    out.p_WB.push_back(poses_of(system, x).p_WB);
    update_kinematics(system.exact_model, x, *kinematics);
    out.momentum.push_back(vector_of(centroidal_momentum(system.exact_model, *kinematics)));
    soles.push_back(sole_places(system, *kinematics));
  }
  out.landings = landings(system, soles);
  for (int t = 0; t < out.landings.count(); ++t)
    for (Landing& landing : out.landings[t]) landing.v *= static_cast<double>(out.factors[t].momentum);
  return out;
}

LaneCost state_cost(const System& system, const Cost& cost, int frame, const State<P>& x, Data<P>& scratch) {
  update_kinematics(system.model, x, scratch);
  LaneCost out{P(0.0), P(0.0)};
  const auto& p_WB = cost.p_WB[frame];
  for (int body = 0; body < kBodies; ++body) {
    const Vec3<P> error =
        scratch.p_WB[body] - Vec3<P>{P(p_WB[body].x()), P(p_WB[body].y()), P(p_WB[body].z())};
    const P square = dot(error, error);
    out.cost += P(cost.position_weight(frame, body)) * square;
    out.worst = max(out.worst, square);
  }
  const Tangent<P> d = difference(x, in_all_lanes<P>(cost.goal[frame]));
  for (int k = kRootRotation; k < kTangent; ++k) {
    const P& e = d[k];
    out.cost += P(cost.tangent_weight(frame, k)) * e * e;
  }
  const auto square_of = [](const Vec3<P>& a, const Eigen::Vector3d& b) {
    const Vec3<P> e = a - Vec3<P>{P(b.x()), P(b.y()), P(b.z())};
    return dot(e, e);
  };
  if (cost.momentum_weight(frame, 0) > 0.0 || cost.momentum_weight(frame, 3) > 0.0) {
    const CentroidalMomentum<P> now = centroidal_momentum(system.model, scratch);
    const Vector6d& goal = cost.momentum[frame];
    out.cost += P(cost.momentum_weight(frame, 0)) * square_of(now.linear, goal.head<3>()) +
                P(cost.momentum_weight(frame, 3)) * square_of(now.angular, goal.tail<3>());
  }
  if (cost.weights.box_sides > 0.0 && has_sides(system)) {
    for (const P& depth : depths_in_sides(system, scratch))
      out.cost += P(cost.weights.box_sides) * depth * depth;
  }
  if (cost.weights.slip > 0.0) {
    for (const Vec3<P>& slip : sole_slip(system, cost.landings[frame], scratch))
      out.cost += P(cost.slip_weight()) * dot(slip, slip);
  }
  return out;
}

Array<double, kDofs> target_distances(const System& system, const Cost& cost, int frame,
                                      const State<double>& x, const Control& u) {
  const Tangent<double> d = difference(x, system.at(frame));
  Array<double, kDofs> e;
  for (int k = 0; k < kDofs; ++k)
    e[k] = static_cast<double>(u[k]) - d[kJointRotation + k] - cost.lead[k] * d[kJointVelocity + k];
  return e;
}

double control_cost(const System& system, const Cost& cost, const Control& u, const Control& before) {
  const CostWeights& w = cost.weights;
  double sum = 0;
  for (std::size_t k = 0; k < kDofs; ++k) {
    const double value = static_cast<double>(u[k]), change = value - static_cast<double>(before[k]);
    sum += w.residual * value * value + w.change * change * change;
  }
  if (!system.assisted) return sum;
  for (std::size_t k = 0; k < kAssistance; ++k) {
    const double value = static_cast<double>(u[kDofs + k]);
    sum += (k < 3 ? w.assistance : w.assistance_spin) * value * value;
  }
  return sum;
}

StateQuadratic state_quadratic(const System& system, const Cost& cost, int frame, const State<double>& x) {
  const BodyPoses poses = poses_of(system, x);
  const Eigen::MatrixXd J = position_jacobian(poses);
  Eigen::VectorXd error(3 * kBodies), weight(3 * kBodies);
  for (int i = 0; i < kBodies; ++i) {
    error.segment<3>(3 * i) = poses.p_WB[i] - cost.p_WB[frame][i];
    weight.segment<3>(3 * i).setConstant(cost.position_weight(frame, i));
  }
  const Eigen::MatrixXd weighted = weight.asDiagonal() * J;
  StateQuadratic out;
  out.value = error.dot(weight.cwiseProduct(error));
  out.gradient = Eigen::VectorXd::Zero(kTangent);
  out.gradient.head(kPositions) = 2.0 * weighted.transpose() * error;
  out.hessian = Eigen::MatrixXd::Zero(kTangent, kTangent);
  out.hessian.topLeftCorner(kPositions, kPositions) = 2.0 * J.transpose() * weighted;
  const Tangent<double> d = difference(x, cost.goal[frame]);
  for (int k = kRootRotation; k < kTangent; ++k) {
    const double w = cost.tangent_weight(frame, k), e = d[k];
    out.value += w * e * e;
    out.gradient[k] += 2.0 * w * e;
    out.hessian(k, k) += 2.0 * w;
  }
  add_momentum_and_contact_terms(system, cost, frame, x, out);
  return out;
}

}  // namespace mimicx::control
