#include "control/tangent.h"

namespace mimicx::control {
namespace {

template <class T>
Vec3<T> axis_of(int body) {
  const Vector3d a = hinge_axis(body);
  return {T(a.x()), T(a.y()), T(a.z())};
}

/// Writes the coordinates of a joint's rotation or velocity v at `out`.
template <class T>
void write_joint(int body, const Vec3<T>& v, T* out) {
  if (is_hinge(body)) {
    out[0] = dot(axis_of<T>(body), v);
  } else {
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
  }
}
template <class T>
Vec3<T> read_joint(int body, const T* in) {
  return is_hinge(body) ? in[0] * axis_of<T>(body) : Vec3<T>{in[0], in[1], in[2]};
}
template <class T>
void write(const Vec3<T>& v, T* out) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

}  // namespace

const Array<Dof, kDofs>& dofs() {
  static const auto table = [] {
    Array<Dof, kDofs> out;
    std::size_t k = 0;
    for (int body = 1; body < kBodies; ++body) {
      if (is_hinge(body)) {
        out[k++] = {body, hinge_axis(body)};
      } else {
        for (int axis = 0; axis < 3; ++axis) out[k++] = {body, Vector3d::Unit(axis)};
      }
    }
    return out;
  }();
  return table;
}

template <class T>
Tangent<T> difference(const State<T>& a, const State<T>& b) {
  Tangent<T> out;
  T* d = out.data();
  write(a.p_root - b.p_root, d);
  write(log_map(conjugate(b.q[0]) * a.q[0]), d + kRootRotation);
  write(a.v_root - b.v_root, d + kRootVelocity);
  write(a.omega[0] - b.omega[0], d + kRootSpin);
  for (int body = 1; body < kBodies; ++body) {
    write_joint(body, log_map(conjugate(b.q[body]) * a.q[body]), d + kJointRotation + first_dof(body));
    write_joint(body, a.omega[body] - b.omega[body], d + kJointVelocity + first_dof(body));
  }
  return out;
}

template <class T>
void retract(State<T>& s, const Tangent<T>& delta) {
  const T* d = delta.data();
  const auto vec = [&](int at) { return Vec3<T>{d[at], d[at + 1], d[at + 2]}; };
  s.p_root += vec(0);
  s.q[0] = s.q[0] * exp_map(vec(kRootRotation));
  s.v_root += vec(kRootVelocity);
  s.omega[0] += vec(kRootSpin);
  for (int body = 1; body < kBodies; ++body) {
    s.q[body] = s.q[body] * exp_map(read_joint(body, d + kJointRotation + first_dof(body)));
    s.omega[body] += read_joint(body, d + kJointVelocity + first_dof(body));
  }
}

#define MIMICX_INSTANTIATE(T)                                              \
  template Tangent<T> difference<T>(const State<T>& a, const State<T>& b); \
  template void retract<T>(State<T> & s, const Tangent<T>& delta);

MIMICX_INSTANTIATE(double)
MIMICX_INSTANTIATE(Pack<kLanes>)

#undef MIMICX_INSTANTIATE

}  // namespace mimicx::control
