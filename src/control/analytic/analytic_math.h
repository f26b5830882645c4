/// Conversions between the simulator's small types and Eigen's, for the tables of the analytic derivatives.
#pragma once

#include "control/analytic/rotation_derivatives.h"
#include "physics/lanes.h"

namespace mimicx::control {

inline Matrix3d to_eigen(const Mat3<double>& m) {
  Matrix3d out;
  for (int k = 0; k < 3; ++k) out.col(k) = to_eigen(m.c[k]);
  return out;
}
inline Matrix3d to_eigen(const Sym3<double>& s) {
  Matrix3d out;
  out.col(0) = Vector3d(s.xx, s.xy, s.xz);
  out.col(1) = Vector3d(s.xy, s.yy, s.yz);
  out.col(2) = Vector3d(s.xz, s.yz, s.zz);
  return out;
}

template <class Real>
void put(Vec3<Real>& out, const Vector3d& v) {
  out = {static_cast<Real>(v.x()), static_cast<Real>(v.y()), static_cast<Real>(v.z())};
}
template <class Real>
void put(Mat3<Real>& out, const Matrix3d& m) {
  for (int k = 0; k < 3; ++k) put(out.c[k], Vector3d(m.col(k)));
}
template <class Real>
void put(Sym3<Real>& out, const Matrix3d& m) {
  const auto e = [&](int row, int col) { return static_cast<Real>(m(row, col)); };
  out = {e(0, 0), e(0, 1), e(0, 2), e(1, 1), e(1, 2), e(2, 2)};
}
template <class Real>
void put(Vec3<Real>& out, const Vec3<double>& v) {
  out = {static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z)};
}
template <class Real>
void put(Mat3<Real>& out, const Mat3<double>& m) {
  for (int k = 0; k < 3; ++k) put(out.c[k], m.c[k]);
}
template <class Real>
void put(Sym3<Real>& out, const Sym3<double>& s) {
  const auto e = [](double x) { return static_cast<Real>(x); };
  out = {e(s.xx), e(s.xy), e(s.xz), e(s.yy), e(s.yz), e(s.zz)};
}

}  // namespace mimicx::control
