#include "control/analytic_floor.h"

#include "control/analytic_math.h"
#include "physics/contact.h"

namespace mimicx::control {
namespace {

/// Columns: θ, ω, v, p_z, then α and a of the body in the solve before.
using Row = Eigen::Matrix<double, 1, 16>;
using Rows = Eigen::Matrix<double, 3, 16>;
constexpr int kTheta = 0, kOmega = 3, kVelocity = 6, kHeight = 9, kAlpha = 10, kAcceleration = 13;

/// Velocity of a point at the end of the step, v + dt a, by the body's tangents, without the part of the
/// accelerations' changes.
/// @param turn  −[R p_B]×, the point's arm by θ
Rows end_velocity(const Matrix3d& turn, const Vector3d& arm, const Vector3d& w, const Vector3d& alpha,
                  double dt) {
  Rows e = Rows::Zero();
  e.middleCols<3>(kTheta) = (skew(w) + dt * (skew(alpha) + skew_product(w, w))) * turn;
  e.middleCols<3>(kOmega) = -skew(arm) - dt * (skew(w.cross(arm)) + skew_product(w, arm));
  e.middleCols<3>(kVelocity).setIdentity();
  return e;
}

/// Force of one contact, docs/physics.md §4, (8), by its body's tangents; added to the rows of `wrench`.
void add_contact(const Model<double>& model, const Data<double>& d, const GroundContact<double>& c,
                 const Vector3d& v_lin, const Accelerations* before, Eigen::Matrix<double, 6, 16>& wrench) {
  const SimulationOptions& o = model.options;
  const ContactPoint& point = model.contacts[static_cast<std::size_t>(c.index)];
  const auto i = static_cast<std::size_t>(point.body);
  const double dt = model.dt, damping = o.ground_damping + dt * o.ground_stiffness;
  const Vector3d arm = eigen(c.arm), w = eigen(d.w[i]);
  const Matrix3d turn = -skew(Vector3d(arm + point.radius * Vector3d::UnitZ()));

  Row depth = Row::Zero();
  depth.segment<3>(kTheta) = -turn.row(2);
  depth[kHeight] = -1.0;
  // The velocity at which f_end and c_t were taken: that of the start, or the one the solve before predicts.
  Rows at;
  if (before == nullptr) {
    at = end_velocity(turn, arm, w, Vector3d::Zero(), 0.0);
  } else {
    at = end_velocity(turn, arm, w, eigen(before->alpha[i]), dt);
    at.middleCols<3>(kAlpha) = -dt * skew(arm);
    at.middleCols<3>(kAcceleration) = dt * Matrix3d::Identity();
  }
  const double slip_2 = v_lin.head<2>().squaredNorm() + o.slip_speed * o.slip_speed;
  const double f_end = o.ground_stiffness * c.depth - damping * v_lin.z();
  const double c_t = o.friction * f_end / std::sqrt(slip_2);
  const Row df_end = o.ground_stiffness * depth - damping * at.row(2);
  const Row dc_t = (c_t / f_end) * df_end - (c_t / slip_2) * (v_lin.x() * at.row(0) + v_lin.y() * at.row(1));

  const Vector3d end = eigen(add_scaled(c.velocity, dt, point_acceleration(model, c, d)));
  const Rows dend = end_velocity(turn, arm, w, eigen(d.a_w[i]), dt);
  Rows force;
  force.row(0) = -c_t * dend.row(0) - end.x() * dc_t;
  force.row(1) = -c_t * dend.row(1) - end.y() * dc_t;
  force.row(2) = o.ground_stiffness * depth - damping * dend.row(2);
  const Vector3d f(-c_t * end.x(), -c_t * end.y(), o.ground_stiffness * c.depth - damping * end.z());
  Rows moment = skew(arm) * force;
  moment.middleCols<3>(kTheta) -= skew(f) * turn;
  wrench.topRows<3>() += moment;
  wrench.bottomRows<3>() += force;
}

}  // namespace

void velocities_at_start(const Data<double>& d, ContactVelocities& out) {
  for (int k = 0; k < d.ground_count; ++k)
    out[static_cast<std::size_t>(k)] = d.ground[static_cast<std::size_t>(k)].velocity;
}

void predicted_velocities(const Model<double>& model, const Data<double>& d, ContactVelocities& out) {
  for (int k = 0; k < d.ground_count; ++k) {
    const GroundContact<double>& c = d.ground[static_cast<std::size_t>(k)];
    out[static_cast<std::size_t>(k)] = add_scaled(c.velocity, model.dt, point_acceleration(model, c, d));
  }
}

template <class Real>
void tabulate_floor(const Model<double>& model, const Data<double>& d, const ContactVelocities& linearised,
                    const Accelerations* before, std::vector<FloorTable<Real>>& out) {
  out.clear();
  Eigen::Matrix<double, 6, 16> wrench;
  const auto finish = [&](int body) {
    FloorTable<Real>& table = out.emplace_back();
    table.body = body;
    for (int row = 0; row < 6; ++row)
      for (int k = 0; k < 16; ++k) table.wrench[row][k] = static_cast<Real>(wrench(row, k));
  };
  int body = -1;  // contacts are sorted by body
  for (int k = 0; k < d.ground_count; ++k) {
    const GroundContact<double>& c = d.ground[static_cast<std::size_t>(k)];
    if (!(c.W_n > 0.0)) continue;  // does not push
    const int on = model.contacts[static_cast<std::size_t>(c.index)].body;
    if (on != body) {
      if (body >= 0) finish(body);
      wrench.setZero();
      body = on;
    }
    add_contact(model, d, c, eigen(linearised[static_cast<std::size_t>(k)]), before, wrench);
  }
  if (body >= 0) finish(body);
}

template void tabulate_floor(const Model<double>&, const Data<double>&, const ContactVelocities&,
                             const Accelerations*, std::vector<FloorTable<float>>&);
template void tabulate_floor(const Model<double>&, const Data<double>&, const ContactVelocities&,
                             const Accelerations*, std::vector<FloorTable<double>>&);

}  // namespace mimicx::control
