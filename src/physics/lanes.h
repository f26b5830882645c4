/// Reads and writes one lane of a pack: vectors, quaternions, whole states and targets.
///
/// The values outside of packs are double (Eigen's types, or State<double> and Target<double>), which holds
/// every float exactly: reading and writing a lane keeps its bits. With T = double there is one lane, 0.
#pragma once

#include "physics/data.h"

namespace mimicx::physics {

template <class T>
void set_lane(Vec3<T>& out, int lane, const Vector3d& v) {
  ScalarTraits<T>::set(out.x, lane, v.x());
  ScalarTraits<T>::set(out.y, lane, v.y());
  ScalarTraits<T>::set(out.z, lane, v.z());
}
template <class T>
void set_lane(Quat<T>& out, int lane, const Quaterniond& q) {
  ScalarTraits<T>::set(out.w, lane, q.w());
  ScalarTraits<T>::set(out.x, lane, q.x());
  ScalarTraits<T>::set(out.y, lane, q.y());
  ScalarTraits<T>::set(out.z, lane, q.z());
}
template <class T>
Vector3d lane_of(const Vec3<T>& v, int lane) {
  using Traits = ScalarTraits<T>;
  return {Traits::get(v.x, lane), Traits::get(v.y, lane), Traits::get(v.z, lane)};
}
template <class T>
Quaterniond lane_of(const Quat<T>& q, int lane) {
  using Traits = ScalarTraits<T>;
  return Quaterniond(Traits::get(q.w, lane), Traits::get(q.x, lane), Traits::get(q.y, lane),
                     Traits::get(q.z, lane));
}

inline Vector3d to_eigen(const Vec3<double>& v) { return {v.x, v.y, v.z}; }
inline Quaterniond to_eigen(const Quat<double>& q) { return Quaterniond(q.w, q.x, q.y, q.z); }
inline Vec3<double> from_eigen(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Quat<double> from_eigen(const Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

/// Calls f(member of a, the same member of b) for every vector and quaternion of two states or two targets.
template <class A, class B, class F>
void for_each_member(State<A>& a, const State<B>& b, F&& f) {
  f(a.p_root, b.p_root);
  f(a.v_root, b.v_root);
  for (int i = 0; i < kBodies; ++i) {
    f(a.q[i], b.q[i]);
    f(a.omega[i], b.omega[i]);
  }
}
template <class A, class B, class F>
void for_each_member(Target<A>& a, const Target<B>& b, F&& f) {
  for (int i = 0; i < kBodies; ++i) {
    f(a.q[i], b.q[i]);
    f(a.omega[i], b.omega[i]);
  }
}

template <class T>
void set_lane(State<T>& out, int lane, const State<double>& s) {
  for_each_member(out, s, [&](auto& to, const auto& from) { set_lane(to, lane, to_eigen(from)); });
}
template <class T>
void set_lane(Target<T>& out, int lane, const Target<double>& target) {
  for_each_member(out, target, [&](auto& to, const auto& from) { set_lane(to, lane, to_eigen(from)); });
}
template <class T>
State<double> lane_of(const State<T>& s, int lane) {
  State<double> out;
  for_each_member(out, s, [&](auto& to, const auto& from) { to = from_eigen(lane_of(from, lane)); });
  return out;
}
template <class T>
Target<double> lane_of(const Target<T>& target, int lane) {
  Target<double> out;
  for_each_member(out, target, [&](auto& to, const auto& from) { to = from_eigen(lane_of(from, lane)); });
  return out;
}

/// Sets every lane to the same value.
template <class T>
void set_all_lanes(Vec3<T>& out, const Vec3<double>& v) {
  out = {T(v.x), T(v.y), T(v.z)};
}
template <class T>
void set_all_lanes(Quat<T>& out, const Quat<double>& q) {
  out = {T(q.w), T(q.x), T(q.y), T(q.z)};
}
template <class T>
State<T> in_all_lanes(const State<double>& s) {
  State<T> out;
  for_each_member(out, s, [&](auto& to, const auto& from) { set_all_lanes(to, from); });
  return out;
}
template <class T>
Target<T> in_all_lanes(const Target<double>& target) {
  Target<T> out;
  for_each_member(out, target, [&](auto& to, const auto& from) { set_all_lanes(to, from); });
  return out;
}

/// Copies lane `from` of a state or target into lane `to` of another one.
template <class Whole>
void copy_lane(Whole& out, int to, const Whole& in, int from) {
  for_each_member(out, in, [&](auto& a, const auto& b) { set_lane(a, to, lane_of(b, from)); });
}

}  // namespace mimicx::physics
