#include "control/analytic_floor.h"

#include "control/analytic_math.h"
#include "physics/contact.h"

namespace mimicx::control {
namespace {

/// Columns: θ, Dω, dv, dp_z, then Dα and Da of the body in the solve before.
using Row = Eigen::Matrix<double, 1, 16>;
using Rows = Eigen::Matrix<double, 3, 16>;
constexpr int kTheta = 0, kOmega = 3, kVelocity = 6, kHeight = 9, kAlpha = 10, kAcceleration = 13;

/// A touching point of a body, nominally.
struct Point {
  Vector3d arm, from_centre;  ///< arm from the joint centre; R p_B, which turns with the body
  Vector3d w;                 ///< of the body
};

/// d of the point's velocity: v + ω × arm.
Rows velocity(const Point& p) {
  Rows e = Rows::Zero();
  // dω = Dω + θ × ω, d arm = θ × R p_B
  e.middleCols<3>(kTheta) = skew_product(p.arm, p.w) - skew_product(p.w, p.from_centre);
  e.middleCols<3>(kOmega) = -skew(p.arm);
  e.middleCols<3>(kVelocity).setIdentity();
  return e;
}

/// Adds dt times d of the point's acceleration, a + α × arm + ω × (ω × arm), to `e`, but for Dα and Da.
/// @param a  against free fall
void add_acceleration(const Point& p, const Vector3d& alpha, const Vector3d& a, double dt, Rows& e) {
  const Vector3d w_x_arm = p.w.cross(p.arm);
  const Matrix3d by_omega = -skew(w_x_arm) - skew_product(p.w, p.arm);
  e.middleCols<3>(kOmega) += dt * by_omega;
  e.middleCols<3>(kTheta) +=
      dt * (-skew(a) + skew_product(p.arm, alpha) - skew_product(alpha, p.from_centre) -
            by_omega * skew(p.w) - skew(p.w) * skew_product(p.w, p.from_centre));
}

Vector3d against_free_fall(const Model<double>& model, const Vec3<double>& a) {
  return to_eigen(a) + model.options.gravity * Vector3d::UnitZ();
}

/// D of the wrench of one contact, docs/physics.md §4, (8), added to the rows of `wrench`.
void add_contact(const Model<double>& model, const Data<double>& d, const GroundContact<double>& c,
                 const Vector3d& v_lin, const Accelerations* before, Eigen::Matrix<double, 6, 16>& wrench) {
  const SimulationOptions& o = model.options;
  const ContactPoint& contact = model.contacts[static_cast<std::size_t>(c.index)];
  const int i = contact.body;
  const double dt = model.dt, damping = o.ground_damping + dt * o.ground_stiffness;
  const Vector3d arm = to_eigen(c.arm);
  const Point point = {arm, arm + contact.radius * Vector3d::UnitZ(), to_eigen(d.w[i])};

  Row depth = Row::Zero();  // −dp_z − (θ × R p_B)_z
  depth.segment<3>(kTheta) = skew(point.from_centre).row(2);
  depth[kHeight] = -1.0;
  const Rows at_start = velocity(point);
  Rows end = at_start, at = at_start;
  add_acceleration(point, to_eigen(d.a_w[i]), against_free_fall(model, d.a_v[i]), dt, end);
  // The velocity at which f_end and c_t were taken is that of the start or the one the solve before predicts.
  if (before != nullptr) {
    add_acceleration(point, to_eigen(before->alpha[i]), against_free_fall(model, before->a[i]), dt, at);
    at.middleCols<3>(kAlpha) = -dt * skew(arm);
    at.middleCols<3>(kAcceleration) = dt * Matrix3d::Identity();
  }
  const double slip_2 = v_lin.head<2>().squaredNorm() + o.slip_speed * o.slip_speed;
  const double f_end = o.ground_stiffness * c.depth - damping * v_lin.z();
  const double c_t = o.friction * f_end / std::sqrt(slip_2);
  const Row df_end = o.ground_stiffness * depth - damping * at.row(2);
  const Row dc_t = (c_t / f_end) * df_end - (c_t / slip_2) * (v_lin.x() * at.row(0) + v_lin.y() * at.row(1));

  const Vector3d v_end = to_eigen(add_scaled(c.velocity, dt, point_acceleration(model, c, d)));
  Rows force;
  force.row(0) = -c_t * end.row(0) - v_end.x() * dc_t;
  force.row(1) = -c_t * end.row(1) - v_end.y() * dc_t;
  force.row(2) = o.ground_stiffness * depth - damping * end.row(2);
  const Vector3d f(-c_t * v_end.x(), -c_t * v_end.y(), o.ground_stiffness * c.depth - damping * v_end.z());
  // d (arm × f) − θ × (arm × f) and df − θ × f
  wrench.topRows<3>() += skew(arm) * force;
  wrench.topLeftCorner<3, 3>() += skew_product(f, point.from_centre) + skew(Vector3d(arm.cross(f)));
  wrench.bottomRows<3>() += force;
  wrench.bottomLeftCorner<3, 3>() += skew(f);
}

}  // namespace

void velocities_at_start(const Data<double>& d, ContactVelocities& out) {
  for (int k = 0; k < d.ground_count; ++k) out[k] = d.ground[static_cast<std::size_t>(k)].velocity;
}

void predicted_velocities(const Model<double>& model, const Data<double>& d, ContactVelocities& out) {
  for (int k = 0; k < d.ground_count; ++k) {
    const GroundContact<double>& c = d.ground[static_cast<std::size_t>(k)];
    out[k] = add_scaled(c.velocity, model.dt, point_acceleration(model, c, d));
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
    add_contact(model, d, c, to_eigen(linearised[k]), before, wrench);
  }
  if (body >= 0) finish(body);
}

template void tabulate_floor(const Model<double>&, const Data<double>&, const ContactVelocities&,
                             const Accelerations*, std::vector<FloorTable<float>>&);
template void tabulate_floor(const Model<double>&, const Data<double>&, const ContactVelocities&,
                             const Accelerations*, std::vector<FloorTable<double>>&);

}  // namespace mimicx::control
