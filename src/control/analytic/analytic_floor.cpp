#include "control/analytic/analytic_floor.h"

#include "control/analytic/analytic_math.h"
#include "physics/contact.h"

namespace mimicx::control {
namespace {

/// Columns: θ, Dω, dv, dp_z, then Dα and Da of the body in the solve before.
using FloorRow = Eigen::Matrix<double, 1, 16>;
using FloorRows = Eigen::Matrix<double, 3, 16>;
constexpr int kTheta = 0, kOmega = 3, kVelocity = 6, kHeight = 9, kAlpha = 10, kAcceleration = 13;

/// A touching point of a body, nominally: its velocity v + ω × arm and the centripetal part of its
/// acceleration, ω × (ω × arm), by θ and Dω. (dω = Dω + θ × ω; the arm changes by θ × R p_B.)
struct Point {
  Vector3d arm, from_centre;  ///< arm from the joint centre; R p_B
  Matrix3d velocity_by_theta, velocity_by_omega, centripetal_by_theta, centripetal_by_omega;
};
Point point_of(const Vector3d& arm, double radius, const Vector3d& w) {
  Point p;
  p.arm = arm;
  p.from_centre = arm + radius * Vector3d::UnitZ();
  p.velocity_by_theta = skew_product(arm, w) - skew_product(w, p.from_centre);
  p.velocity_by_omega = -skew(arm);
  p.centripetal_by_omega = -skew(w.cross(arm)) - skew_product(w, arm);
  p.centripetal_by_theta = -p.centripetal_by_omega * skew(w) - skew(w) * skew_product(w, p.from_centre);
  return p;
}

/// d of the point's velocity at the start of the step.
FloorRows velocity(const Point& p) {
  FloorRows rows = FloorRows::Zero();
  rows.middleCols<3>(kTheta) = p.velocity_by_theta;
  rows.middleCols<3>(kOmega) = p.velocity_by_omega;
  rows.middleCols<3>(kVelocity).setIdentity();
  return rows;
}
/// … and at its end, v + dt a, but for Dα and Da. @param a  against free fall
FloorRows end_velocity(const Point& p, const Vector3d& alpha, const Vector3d& a, double dt) {
  FloorRows rows = velocity(p);
  rows.middleCols<3>(kTheta) += dt * (p.centripetal_by_theta - skew(a) + skew_product(p.arm, alpha) -
                                      skew_product(alpha, p.from_centre));
  rows.middleCols<3>(kOmega) += dt * p.centripetal_by_omega;
  return rows;
}

Vector3d against_free_fall(const Model<double>& model, const Vec3<double>& a) {
  return to_eigen(a) + model.config.gravity * Vector3d::UnitZ();
}

/// D of the wrench of one contact, docs/physics.md §4, (8), added to the rows of `wrench`.
void add_contact(const Model<double>& model, const Data<double>& d, const GroundContact<double>& c,
                 const Vector3d& velocity_used, const Accelerations* before,
                 Eigen::Matrix<double, 6, 16>& wrench) {
  const SimulationConfig& o = model.config;
  const ContactPoint& contact = model.contacts[c.index];
  const int i = contact.body;
  const double k = c.surface.stiffness, dt = model.dt, damping = c.surface.damping + dt * k;
  const Vector3d arm = to_eigen(c.arm);
  const Point point = point_of(arm, contact.radius, to_eigen(d.w[i]));

  FloorRow depth = FloorRow::Zero();  // −dp_z − (θ × R p_B)_z; a plate's push stops growing at some depth
  if (!c.surface.capped) {
    depth.segment<3>(kTheta) = skew(point.from_centre).row(2);
    depth[kHeight] = -1.0;
  }
  const FloorRows end = end_velocity(point, to_eigen(d.a_w[i]), against_free_fall(model, d.a_v[i]), dt);
  // The velocity at which f_end and c_t were taken is that of the start or the one the solve before predicts.
  FloorRows at;
  if (before == nullptr) {
    at = velocity(point);
  } else {
    at = end_velocity(point, to_eigen(before->alpha[i]), against_free_fall(model, before->a[i]), dt);
    at.middleCols<3>(kAlpha) = -dt * skew(arm);
    at.middleCols<3>(kAcceleration) = dt * Matrix3d::Identity();
  }
  const double slip_2 = velocity_used.head<2>().squaredNorm() + o.slip_speed * o.slip_speed;
  const double f_end = k * c.surface.depth - damping * velocity_used.z();
  double c_t = o.friction * f_end / std::sqrt(slip_2);
  const FloorRow df_end = k * depth - damping * at.row(2);
  // docs/control_derivatives.md §3, (7)
  FloorRow dc_t = (c_t / f_end) * df_end -
                  (c_t / slip_2) * (velocity_used.x() * at.row(0) + velocity_used.y() * at.row(1));
  if (const double most = kMostFrictionMass / dt; c_t > most) {
    c_t = most;
    dc_t.setZero();
  }

  const Vector3d v_end = to_eigen(add_scaled(c.velocity, dt, point_acceleration(model, c, d)));
  FloorRows force;
  force.row(0) = -c_t * end.row(0) - v_end.x() * dc_t;
  force.row(1) = -c_t * end.row(1) - v_end.y() * dc_t;
  force.row(2) = k * depth - damping * end.row(2);
  const Vector3d f(-c_t * v_end.x(), -c_t * v_end.y(), k * c.surface.depth - damping * v_end.z());
  // d (arm × f) − θ × (arm × f) and df − θ × f
  wrench.topRows<3>() += skew(arm) * force;
  wrench.topLeftCorner<3, 3>() += skew_product(f, point.from_centre) + skew(Vector3d(arm.cross(f)));
  wrench.bottomRows<3>() += force;
  wrench.bottomLeftCorner<3, 3>() += skew(f);
}

}  // namespace

void velocities_at_start(const Data<double>& d, ContactVelocities& out) {
  for (int k = 0; k < d.ground_count; ++k) out[k] = d.ground[k].velocity;
}

void predicted_velocities(const Model<double>& model, const Data<double>& d, ContactVelocities& out) {
  for (int k = 0; k < d.ground_count; ++k) {
    const GroundContact<double>& c = d.ground[k];
    out[k] = add_scaled(c.velocity, model.dt, point_acceleration(model, c, d));
  }
}

template <class Real>
void tabulate_floor(const Model<double>& model, const Data<double>& d, const ContactVelocities& linearised,
                    const Accelerations* before, List<FloorTable<Real>>& out) {
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
    const GroundContact<double>& c = d.ground[k];
    if (!(c.W_n > 0.0)) continue;  // does not push
    const int on = model.contacts[c.index].body;
    if (on != body) {
      if (body >= 0) finish(body);
      wrench.setZero();
      body = on;
    }
    add_contact(model, d, c, to_eigen(linearised[k]), before, wrench);
  }
  if (body >= 0) finish(body);
}

template void tabulate_floor(const Model<double>&, const Data<double>&, const ContactVelocities&,
                             const Accelerations*, List<FloorTable<float>>&);
template void tabulate_floor(const Model<double>&, const Data<double>&, const ContactVelocities&,
                             const Accelerations*, List<FloorTable<double>>&);

}  // namespace mimicx::control
