#include "control/analytic/analytic_self.h"

#include "control/analytic/analytic_math.h"
#include "physics/contact.h"

namespace mimicx::control {
namespace {

/// A capsule's axis in world axes.
struct Axis {
  Vector3d start, along, p;  ///< start from the joint centre, vector to the end; joint centre, m
};
Axis segment_axis(const Model<double>& model, const Data<double>& d, int body) {
  const Capsule& c = model.capsule[body];
  const Matrix3d R = to_eigen(d.R_WB[body]);
  return {R * c.a_B, R * (c.b_B - c.a_B), to_eigen(d.p_WB[body])};
}

/// Parameters of the closest points, and their derivatives by (u·w, w·r, u·r): those of
/// `closest_on_segments` line by line. The lengths of u and w do not change.
struct Closest {
  double s, t;
  Array<double, 3> ds{}, dt{};
};
Closest closest(const Vector3d& u, const Vector3d& w, const Vector3d& r) {
  constexpr double kTiny = 1e-9;
  const double a = std::max(u.squaredNorm(), kTiny), e = std::max(w.squaredNorm(), kTiny);
  const double b = u.dot(w), f = w.dot(r), c = u.dot(r), determinant = a * e - b * b;
  const double denominator = std::max(determinant, kTiny);
  const auto inside = [](double x) { return x > 0.0 && x < 1.0; };
  Closest out;
  const double s = (b * f - c * e) / denominator;
  out.s = std::clamp(s, 0.0, 1.0);
  if (inside(s))
    out.ds = {(f + (determinant > kTiny ? 2.0 * b * s : 0.0)) / denominator, b / denominator,
              -e / denominator};
  const double t = (b * out.s + f) / e;
  out.t = std::clamp(t, 0.0, 1.0);
  if (inside(t)) {
    out.dt = {(out.s + b * out.ds[0]) / e, (b * out.ds[1] + 1.0) / e, b * out.ds[2] / e};
    return out;
  }
  const double again = (b * out.t - c) / a;
  out.s = std::clamp(again, 0.0, 1.0);
  out.ds = {};
  if (inside(again)) out.ds = {out.t / a, 0.0, -1.0 / a};
  return out;
}

/// Columns: θ, Dω, dv, dp of body i, then of body j.
using PairRow = Eigen::Matrix<double, 1, 24>;
using PairRows = Eigen::Matrix<double, 3, 24>;

/// a × x and x × a for a vector a that does not change.
PairRows cross(const Vector3d& a, const PairRows& x) { return skew(a) * x; }
PairRows cross(const PairRows& x, const Vector3d& a) { return -skew(a) * x; }

/// Motion of one of the two bodies.
struct Mover {
  PairRows theta = PairRows::Zero(), w = PairRows::Zero(), v = PairRows::Zero(), p = PairRows::Zero();

  Mover(int first, const Vector3d& omega) {
    theta.middleCols<3>(first).setIdentity();
    w.middleCols<3>(first + 3).setIdentity();
    w += cross(theta, omega);  // dω = Dω + θ × ω
    v.middleCols<3>(first + 6).setIdentity();
    p.middleCols<3>(first + 9).setIdentity();
  }
};

/// The penalty force of two capsules: `add_self_contact` of physics/contact.h line by line.
/// @return false where they do not push
bool differentiate_pair(const Model<double>& model, const Data<double>& d, int i, int j,
                        Eigen::Matrix<double, 12, 24>& wrench) {
  const double k = model.config.self_stiffness, damping = model.config.self_damping;
  const Axis a = segment_axis(model, d, i), b = segment_axis(model, d, j);
  const Vector3d apart = (a.p + a.start) - (b.p + b.start), w_i = to_eigen(d.w[i]), w_j = to_eigen(d.w[j]);
  const Closest c = closest(a.along, b.along, apart);
  const Vector3d on_i = a.start + c.s * a.along, on_j = b.start + c.t * b.along;
  const Vector3d gap = (a.p + on_i) - (b.p + on_j);
  const double distance = gap.norm(), depth = model.capsule[i].radius + model.capsule[j].radius - distance;
  if (!(depth > 0.0 && distance > 1e-6)) return false;
  const Vector3d n = gap / distance;
  const double reach =
      model.capsule[j].radius - 0.5 * depth;  // from the closest point of j to the common point
  const Vector3d point = b.p + on_j + reach * n, arm_i = point - a.p, arm_j = point - b.p;
  const Vector3d v = (to_eigen(d.v[i]) + w_i.cross(arm_i)) - (to_eigen(d.v[j]) + w_j.cross(arm_j));
  const double push = k * depth - damping * v.dot(n);
  if (!(push > 0.0)) return false;
  const Vector3d f = push * n;

  const Mover move_i(0, w_i), move_j(12, w_j);
  const PairRows du = cross(move_i.theta, a.along), dw = cross(move_j.theta, b.along);
  const PairRows dr = move_i.p + cross(move_i.theta, a.start) - move_j.p - cross(move_j.theta, b.start);
  const PairRow u_w = b.along.transpose() * du + a.along.transpose() * dw;
  const PairRow w_r = apart.transpose() * dw + b.along.transpose() * dr;
  const PairRow u_r = apart.transpose() * du + a.along.transpose() * dr;
  const PairRow ds = c.ds[0] * u_w + c.ds[1] * w_r + c.ds[2] * u_r,
                dt = c.dt[0] * u_w + c.dt[1] * w_r + c.dt[2] * u_r;
  const PairRows don_i = move_i.p + cross(move_i.theta, on_i) + a.along * ds;
  const PairRows don_j = move_j.p + cross(move_j.theta, on_j) + b.along * dt;
  const PairRow ddistance = n.transpose() * (don_i - don_j);
  const PairRows dn = (don_i - don_j - n * ddistance) / distance;
  const PairRows dpoint = don_j + reach * dn + 0.5 * n * ddistance;
  const PairRows darm_i = dpoint - move_i.p, darm_j = dpoint - move_j.p;
  const PairRows dv = (move_i.v + cross(move_i.w, arm_i) + cross(w_i, darm_i)) -
                      (move_j.v + cross(move_j.w, arm_j) + cross(w_j, darm_j));
  const PairRow dpush = -k * ddistance - damping * (n.transpose() * dv + v.transpose() * dn);
  const PairRows df = n * dpush + push * dn;
  wrench.middleRows<3>(0) =
      cross(darm_i, f) + cross(arm_i, df) - cross(move_i.theta, Vector3d(arm_i.cross(f)));
  wrench.middleRows<3>(3) = df - cross(move_i.theta, f);
  wrench.middleRows<3>(6) =
      cross(move_j.theta, Vector3d(arm_j.cross(f))) - cross(darm_j, f) - cross(arm_j, df);
  wrench.middleRows<3>(9) = cross(move_j.theta, f) - df;
  return true;
}

}  // namespace

template <class Real>
void tabulate_self_contact(const Model<double>& model, const Data<double>& d,
                           List<SelfPairTable<Real>>& out) {
  out.clear();
  if (!model.config.self_contact) return;
  for (const auto& pair : model.self_pairs) {
    const int i = pair[0], j = pair[1];
    // Bodies without a self-contact force have no pair.
    const auto touched = [&](int body) {
      const Vec3<double>& f = d.self_wrench[body].f;
      return dot(f, f) > 0.0;
    };
    Eigen::Matrix<double, 12, 24> wrench;
    if (!touched(i) || !touched(j) || !differentiate_pair(model, d, i, j, wrench)) continue;
    SelfPairTable<Real>& table = out.emplace_back();
    table.i = i;
    table.j = j;
    for (int row = 0; row < 12; ++row)
      for (int k = 0; k < 24; ++k) table.wrench[row][k] = static_cast<Real>(wrench(row, k));
  }
}

template void tabulate_self_contact(const Model<double>&, const Data<double>&, List<SelfPairTable<float>>&);
template void tabulate_self_contact(const Model<double>&, const Data<double>&, List<SelfPairTable<double>>&);

}  // namespace mimicx::control
