#include "control/cost/sole_slip.h"

#include <algorithm>
#include <type_traits>

#include "physics/contact.h"

namespace mimicx::control {
namespace {

template <class T>
const Model<RealOf<T>>& model_of(const System& system) {
  if constexpr (std::is_same_v<T, double>)
    return system.exact_model;
  else
    return system.model;
}

Vector3d spin(const Data<double>& d, int body) { return body < 0 ? Vector3d::Zero() : to_eigen(d.w[body]); }

/// A point that is fixed to a body: world, m, m/s.
template <class T>
struct PointMotion {
  Vec3<T> p, v;
};
template <class T>
PointMotion<T> motion_of(const SolePoint& point, const Data<T>& d) {
  const Vec3<T> p_B{T(point.p_B.x()), T(point.p_B.y()), T(point.p_B.z())};
  const Vec3<T> arm = d.R_WB[point.body] * p_B;
  return {d.p_WB[point.body] + arm, d.v[point.body] + cross(d.w[point.body], arm)};
}

/// Derivatives of a point's velocity v when the joint of `body` turns about the world axis a: the part of the
/// velocity that is relative to the parent turns with it, and the parent's rotation moves the point
/// elsewhere. @param arm  from the joint to the point, m
Vector3d by_angle(const Data<double>& d, int body, const Vector3d& arm, const Vector3d& v,
                  const Vector3d& a) {
  const Vector3d w = spin(d, kParents[body]);
  const Vector3d relative = v - to_eigen(d.v[body]) - w.cross(arm);
  return a.cross(relative) + w.cross(a.cross(arm));
}

/// ν of a height, m
template <class T>
T nearness(const T& z) {
  using std::max;
  const T over = max(z, T(0.0)) * T(1.0 / kNearFloor);
  return T(1.0) / fma(over, over, T(1.0));
}
/// Its derivative
double nearness_slope(double z) {
  const double near = nearness(z);
  return -2.0 * std::max(z, 0.0) / (kNearFloor * kNearFloor) * near * near;
}

}  // namespace

SolePlaces sole_places(const System& system, const Data<double>& d) {
  SolePlaces places;
  for (int k = 0; k < kFootPoints; ++k) places[k] = motion_of(system.sole[k], d).p;
  return places;
}

List<Landings> landings(const System& system, const List<SolePlaces>& goal) {
  const int last = goal.count() - 1;
  /// d_t, m
  const auto way = [&](int t, int k) {
    return Eigen::Vector2d(to_eigen(goal[std::min(t + 1, last)][k] - goal[t][k]).head<2>());
  };
  /// 1 / (1 + (|d|/scale)²)
  const auto rests = [](const Eigen::Vector2d& d, double scale) {
    return 1.0 / (1.0 + d.squaredNorm() / (scale * scale));
  };
  const auto stands = [&](int t, int k) {
    const Vec3<double>& p = goal[t][k];
    return nearness(p.z - ground_height(system.exact_model, p)) * rests(way(t, k), kNearFloor);
  };
  List<Landings> out(goal.size());
  for (int t = 0; t <= last; ++t)
    for (int k = 0; k < kFootPoints; ++k) {
      Landing& landing = out[t][k];
      for (int s = t + 1; s <= std::min(t + kFramesAhead, last); ++s)
        landing.near = std::max(landing.near, stands(s, k));
      landing.near *= rests(way(t, k), kSwinging);
      landing.v = landing.near * system.fps * way(t, k);
    }
  return out;
}

template <class T>
Array<Vec3<T>, kFootPoints> sole_slip(const System& system, const Landings& goal, const Data<T>& d) {
  using std::max;
  const Model<RealOf<T>>& model = model_of<T>(system);
  Array<Vec3<T>, kFootPoints> slip;
  for (int k = 0; k < kFootPoints; ++k) {
    const auto [p, v] = motion_of(system.sole[k], d);
    const T own = nearness(p.z - ground_height(model, p)), high = T(1.0) - own;
    const T near = max(own, T(goal[k].near));
    slip[k] = {near * v.x - high * T(goal[k].v.x()), near * v.y - high * T(goal[k].v.y()), T(0.0)};
  }
  return slip;
}

SoleSlipJacobian sole_slip_jacobian(const System& system, const Landings& goal, const Data<double>& d) {
  SoleSlipJacobian J = SoleSlipJacobian::Zero();
  for (int k = 0; k < kFootPoints; ++k) {
    const PointMotion<double> motion = motion_of(system.sole[k], d);
    const Vector3d p = to_eigen(motion.p), v = to_eigen(motion.v);
    const double z = p.z() - ground_height(system.exact_model, motion.p), own = nearness(z);
    const double near = std::max(own, goal[k].near);
    Eigen::Vector2d by_nearness = goal[k].v;
    if (own > goal[k].near) by_nearness += v.head<2>();
    const Eigen::Vector2d by_height = nearness_slope(z) * by_nearness;
    auto rows = J.middleRows<2>(2 * k);
    rows.col(2) = by_height;
    rows.block<2, 2>(0, kRootVelocity).diagonal().setConstant(near);
    for_each_rotation(d, system.sole[k].body, [&](int body, const Vector3d& a, int coordinate) {
      const Vector3d arm = p - to_eigen(d.p_WB[body]);
      const Vector3d moved = a.cross(arm), faster = by_angle(d, body, arm, v, a);
      rows.col(coordinate) = near * faster.head<2>() + moved.z() * by_height;
      rows.col(kPositions + coordinate) = near * moved.head<2>();
    });
  }
  return J;
}

template Array<Vec3<double>, kFootPoints> sole_slip(const System&, const Landings&, const Data<double>&);
template Array<Vec3<P>, kFootPoints> sole_slip(const System&, const Landings&, const Data<P>&);

}  // namespace mimicx::control
