#include "control/analytic_self.h"

#include "control/analytic_math.h"
#include "physics/contact.h"

namespace mimicx::control {
namespace {

/// A capsule's axis in world axes.
struct Axis {
  Vector3d start, along, p;  ///< start from the joint centre, vector to the end; joint centre, m
};
Axis axis_of(const Model<double>& model, const Data<double>& d, std::size_t body) {
  const Capsule& c = model.capsule[body];
  const Matrix3d R = eigen(d.R_WB[body]);
  return {R * c.a_B, R * (c.b_B - c.a_B), eigen(d.p_WB[body])};
}

/// Parameters of the closest points, and their derivatives by (u·w, w·r, u·r): those of
/// `closest_on_segments` line by line. The lengths of u and w do not change.
struct Closest {
  double s, t;
  std::array<double, 3> ds{}, dt{};
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

template <class Real>
void fill(const Model<double>& model, const Data<double>& d, std::size_t i, std::size_t j,
          std::vector<SelfPairTable<Real>>& out) {
  const Axis on_i = axis_of(model, d, i), on_j = axis_of(model, d, j);
  const Vector3d apart = (on_i.p + on_i.start) - (on_j.p + on_j.start);
  const Closest c = closest(on_i.along, on_j.along, apart);
  const Vector3d point_i = on_i.start + c.s * on_i.along, point_j = on_j.start + c.t * on_j.along;
  const Vector3d gap = (on_i.p + point_i) - (on_j.p + point_j);
  const double distance = gap.norm(), depth = model.capsule[i].radius + model.capsule[j].radius - distance;
  if (!(depth > 0.0 && distance > 1e-6)) return;
  const Vector3d normal = gap / distance;
  const double reach = model.capsule[j].radius - 0.5 * depth;
  const Vector3d point = on_j.p + point_j + reach * normal;
  const Vector3d arm_i = point - on_i.p, arm_j = point - on_j.p;
  const Vector3d v =
      (eigen(d.v[i]) + eigen(d.w[i]).cross(arm_i)) - (eigen(d.v[j]) + eigen(d.w[j]).cross(arm_j));
  const double push = model.options.self_stiffness * depth - model.options.self_damping * v.dot(normal);
  if (!(push > 0.0)) return;

  SelfPairTable<Real>& t = out.emplace_back();
  t.i = static_cast<int>(i);
  t.j = static_cast<int>(j);
  put(t.axis_i, on_i.along);
  put(t.axis_j, on_j.along);
  put(t.start_i, on_i.start);
  put(t.start_j, on_j.start);
  put(t.apart, apart);
  put(t.on_i, point_i);
  put(t.on_j, point_j);
  for (std::size_t k = 0; k < 3; ++k) {
    t.s[k] = static_cast<Real>(c.ds[k]);
    t.t[k] = static_cast<Real>(c.dt[k]);
  }
  put(t.normal, normal);
  put(t.arm_i, arm_i);
  put(t.arm_j, arm_j);
  put(t.velocity, v);
  put(t.force, Vector3d(push * normal));
  t.inverse_distance = static_cast<Real>(1.0 / distance);
  t.reach = static_cast<Real>(reach);
  t.push = static_cast<Real>(push);
}

}  // namespace

template <class Real>
void tabulate_self_contact(const Model<double>& model, const Data<double>& d,
                           std::vector<SelfPairTable<Real>>& out) {
  out.clear();
  if (!model.options.self_contact) return;
  for (const auto& pair : model.self_pairs) {
    const auto i = static_cast<std::size_t>(pair[0]), j = static_cast<std::size_t>(pair[1]);
    // Bodies on which nothing pushes meet nobody.
    const auto touched = [&](std::size_t body) {
      const Vec3<double>& f = d.self_wrench[body].f;
      return dot(f, f) > 0.0;
    };
    if (touched(i) && touched(j)) fill(model, d, i, j, out);
  }
}

template void tabulate_self_contact(const Model<double>&, const Data<double>&,
                                    std::vector<SelfPairTable<float>>&);
template void tabulate_self_contact(const Model<double>&, const Data<double>&,
                                    std::vector<SelfPairTable<double>>&);

}  // namespace mimicx::control
