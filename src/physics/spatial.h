/// Vectors, matrices, quaternions and articulated inertias over the simulator's scalar type T.
///
/// Spatial vectors are (angular; linear), always in axes parallel to the world's and about the body's own
/// joint centre. A change of coordinates X between such frames is a pure translation, which makes the passes
/// short (docs/physics.md §2). Products that are added are fused explicitly.
#pragma once

#include "core/elementary.h"
#include "core/so3.h"
#include "physics/pack.h"

namespace mimicx::physics {

// The overloads for lanes below would hide those of core/so3.h.
using mimicx::exp_map;
using mimicx::log_map;

template <class T>
struct Vec3 {
  T x, y, z;
  Vec3& operator+=(const Vec3& b) {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }
  Vec3& operator-=(const Vec3& b) {
    x -= b.x;
    y -= b.y;
    z -= b.z;
    return *this;
  }
};
template <class T>
Vec3<T> zero3() {
  return {T(0.0), T(0.0), T(0.0)};
}
template <class T>
Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
Vec3<T> operator-(const Vec3<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class T>
Vec3<T> operator*(T s, const Vec3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}
template <class T>
Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)), fma(a.x, b.y, -(a.y * b.x))};
}
/// a + s·b
template <class T>
Vec3<T> add_scaled(const Vec3<T>& a, T s, const Vec3<T>& b) {
  return {fma(s, b.x, a.x), fma(s, b.y, a.y), fma(s, b.z, a.z)};
}
template <class T>
T norm(const Vec3<T>& a) {
  return sqrt(dot(a, a));
}
template <class T>
Vec3<T> select(const MaskOf<T>& mask, const Vec3<T>& a, const Vec3<T>& b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}
/// A model constant as a T in every lane.
template <class T>
Vec3<T> spread(const Vec3<RealOf<T>>& a) {
  return {T(a.x), T(a.y), T(a.z)};
}

/// Symmetric 3×3.
template <class T>
struct Sym3 {
  T xx, xy, xz, yy, yz, zz;
  Sym3& operator+=(const Sym3& b) {
    xx += b.xx;
    xy += b.xy;
    xz += b.xz;
    yy += b.yy;
    yz += b.yz;
    zz += b.zz;
    return *this;
  }
};
template <class T>
Sym3<T> operator-(const Sym3<T>& a, const Sym3<T>& b) {
  return {a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yy - b.yy, a.yz - b.yz, a.zz - b.zz};
}
template <class T>
Vec3<T> operator*(const Sym3<T>& s, const Vec3<T>& v) {
  return {fma(s.xx, v.x, fma(s.xy, v.y, s.xz * v.z)), fma(s.xy, v.x, fma(s.yy, v.y, s.yz * v.z)),
          fma(s.xz, v.x, fma(s.yz, v.y, s.zz * v.z))};
}
/// s + d·1
template <class T>
Sym3<T> add_diagonal(Sym3<T> s, T d) {
  s.xx += d;
  s.yy += d;
  s.zz += d;
  return s;
}
/// Inverse by cofactors; s must be positive definite.
template <class T>
Sym3<T> inverse(const Sym3<T>& s) {
  const T a = fma(s.yy, s.zz, -(s.yz * s.yz)), b = fma(s.xz, s.yz, -(s.xy * s.zz)),
          c = fma(s.xy, s.yz, -(s.xz * s.yy));
  const T r = T(1.0) / fma(s.xx, a, fma(s.xy, b, s.xz * c));
  return {r * a,
          r * b,
          r * c,
          r * fma(s.xx, s.zz, -(s.xz * s.xz)),
          r * fma(s.xy, s.xz, -(s.xx * s.yz)),
          r * fma(s.xx, s.yy, -(s.xy * s.xy))};
}

/// General 3×3, columns c[0..2].
template <class T>
struct Mat3 {
  Vec3<T> c[3];
};
template <class T>
Vec3<T> operator*(const Mat3<T>& m, const Vec3<T>& v) {
  return {fma(m.c[0].x, v.x, fma(m.c[1].x, v.y, m.c[2].x * v.z)),
          fma(m.c[0].y, v.x, fma(m.c[1].y, v.y, m.c[2].y * v.z)),
          fma(m.c[0].z, v.x, fma(m.c[1].z, v.y, m.c[2].z * v.z))};
}
/// mᵀ v
template <class T>
Vec3<T> transpose_times(const Mat3<T>& m, const Vec3<T>& v) {
  return {dot(m.c[0], v), dot(m.c[1], v), dot(m.c[2], v)};
}
/// Symmetric times general.
template <class T>
Mat3<T> operator*(const Sym3<T>& s, const Mat3<T>& m) {
  return {{s * m.c[0], s * m.c[1], s * m.c[2]}};
}
/// R s Rᵀ
template <class T>
Sym3<T> congruence(const Mat3<T>& R, const Sym3<T>& s) {
  // Columns of R s, then its rows against the rows of R; only six entries are needed.
  const Mat3<T> m = {{{fma(R.c[0].x, s.xx, fma(R.c[1].x, s.xy, R.c[2].x * s.xz)),
                       fma(R.c[0].y, s.xx, fma(R.c[1].y, s.xy, R.c[2].y * s.xz)),
                       fma(R.c[0].z, s.xx, fma(R.c[1].z, s.xy, R.c[2].z * s.xz))},
                      {fma(R.c[0].x, s.xy, fma(R.c[1].x, s.yy, R.c[2].x * s.yz)),
                       fma(R.c[0].y, s.xy, fma(R.c[1].y, s.yy, R.c[2].y * s.yz)),
                       fma(R.c[0].z, s.xy, fma(R.c[1].z, s.yy, R.c[2].z * s.yz))},
                      {fma(R.c[0].x, s.xz, fma(R.c[1].x, s.yz, R.c[2].x * s.zz)),
                       fma(R.c[0].y, s.xz, fma(R.c[1].y, s.yz, R.c[2].y * s.zz)),
                       fma(R.c[0].z, s.xz, fma(R.c[1].z, s.yz, R.c[2].z * s.zz))}}};
  const auto entry = [&](T Vec3<T>::*i, T Vec3<T>::*j) {
    return fma(m.c[0].*i, R.c[0].*j, fma(m.c[1].*i, R.c[1].*j, (m.c[2].*i) * (R.c[2].*j)));
  };
  using Vec = Vec3<T>;
  return {entry(&Vec::x, &Vec::x), entry(&Vec::x, &Vec::y), entry(&Vec::x, &Vec::z),
          entry(&Vec::y, &Vec::y), entry(&Vec::y, &Vec::z), entry(&Vec::z, &Vec::z)};
}

/// Unit Hamilton quaternion.
template <class T>
struct Quat {
  T w, x, y, z;
};
template <class T>
Quat<T> operator*(const Quat<T>& a, const Quat<T>& b) {
  return {fma(a.w, b.w, -fma(a.x, b.x, fma(a.y, b.y, a.z * b.z))),
          fma(a.w, b.x, fma(a.x, b.w, fma(a.y, b.z, -(a.z * b.y)))),
          fma(a.w, b.y, fma(a.y, b.w, fma(a.z, b.x, -(a.x * b.z)))),
          fma(a.w, b.z, fma(a.z, b.w, fma(a.x, b.y, -(a.y * b.x))))};
}
template <class T>
Quat<T> conjugate(const Quat<T>& a) {
  return {a.w, -a.x, -a.y, -a.z};
}
template <class T>
Quat<T> spread(const Quat<RealOf<T>>& a) {
  return {T(a.w), T(a.x), T(a.y), T(a.z)};
}
template <class T>
Mat3<T> to_matrix(const Quat<T>& q) {
  const T two(2.0), one(1.0);
  const T x2 = two * q.x, y2 = two * q.y, z2 = two * q.z;
  const T xx = q.x * x2, yy = q.y * y2, zz = q.z * z2, wx = q.w * x2, wy = q.w * y2, wz = q.w * z2;
  return {{{one - (yy + zz), fma(q.x, y2, wz), fma(q.x, z2, -wy)},
           {fma(q.x, y2, -wz), one - (xx + zz), fma(q.y, z2, wx)},
           {fma(q.x, z2, wy), fma(q.y, z2, -wx), one - (xx + yy)}}};
}
/// One Newton step towards unit length: for quaternions that have only drifted by rounding.
template <class T>
Quat<T> renormalised(const Quat<T>& q) {
  const T s = fma(T(-0.5), fma(q.w, q.w, fma(q.x, q.x, fma(q.y, q.y, q.z * q.z))), T(1.5));
  return {s * q.w, s * q.x, s * q.y, s * q.z};
}

/// Rotation vector → quaternion, by Taylor series in θ²: error under 1e-7 up to θ = π, where the simulator
/// stops (a joint that turns half a circle within one step is flagged as run away).
template <class T>
Quat<T> exp_map(const Vec3<T>& r) {
  const T h = T(0.25) * min(dot(r, r), T(9.8696044));  // (θ/2)²
  const T cosine =
      fma(h,
          fma(h,
              fma(h,
                  fma(h, fma(h, fma(h, T(1.0 / 479001600.0), T(-1.0 / 3628800.0)), T(1.0 / 40320.0)),
                      T(-1.0 / 720.0)),
                  T(1.0 / 24.0)),
              T(-0.5)),
          T(1.0));
  const T sinc = fma(
      h,
      fma(h,
          fma(h, fma(h, fma(h, T(-1.0 / 39916800.0), T(1.0 / 362880.0)), T(-1.0 / 5040.0)), T(1.0 / 120.0)),
          T(-1.0 / 6.0)),
      T(1.0));
  const T s = T(0.5) * sinc;
  return {cosine, s * r.x, s * r.y, s * r.z};
}
inline Quat<double> exp_map(const Vec3<double>& r) {
  const Quaterniond q = exp_map(Vector3d(r.x, r.y, r.z));
  return {q.w(), q.x(), q.y(), q.z()};
}

/// θ/sin(θ/2) as a function of w = cos(θ/2) ≥ 0; log(q) = log_scale(w)·(x, y, z).
/// The function is analytic on [0, 1] (its singularity is at w = −1), so a Chebyshev interpolant of degree
/// 11 in 2w − 1 is accurate to float rounding; no square root, no quotient 0/0.
inline double log_scale(double w) {
  const double sine = std::sqrt(std::max(0.0, 1.0 - w * w));
  return sine < 1e-5 ? 2.0 + sine * sine / 3.0 : 2.0 * atan2(sine, w) / sine;
}
template <int N>
Pack<N> log_scale(Pack<N> w) {
  constexpr double coefficients[] = {2.418399152,     -0.5272002823,    0.1394664367,    -0.03967431073,
                                     0.01172264947,   -0.003545661365,  0.001092104357,  -0.000339441426,
                                     0.0001013603932, -3.196011876e-05, 1.462352514e-05, -4.670562097e-06};
  const Pack<N> x = fma(Pack<N>(2.0), w, Pack<N>(-1.0));
  Pack<N> sum(coefficients[11]);
  for (int k = 10; k >= 0; --k) sum = fma(sum, x, Pack<N>(coefficients[k]));
  return sum;
}
/// Quaternion → rotation vector of the shorter way.
template <class T>
Vec3<T> log_map(const Quat<T>& q) {
  const T sign = select(q.w < T(0.0), T(-1.0), T(1.0));
  const T s = sign * log_scale(min(sign * q.w, T(1.0)));
  return {s * q.x, s * q.y, s * q.z};
}

/// Inertia of a (rigid or articulated) body about its joint centre, as the map
/// (moment n; force f) = [A B; Bᵀ C] (α; a).
template <class T>
struct Inertia {
  Sym3<T> A;
  Mat3<T> B;
  Sym3<T> C;
};

}  // namespace mimicx::physics
