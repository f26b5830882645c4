#include "physics/control_interval.h"

namespace mimicx::physics {
namespace {

template <class T>
Quat<T> interpolate(const Quat<T>& a, const Quat<T>& b, T s) {
  const T cosine = fma(a.w, b.w, fma(a.x, b.x, fma(a.y, b.y, a.z * b.z)));
  const T wb = select(cosine < T(0.0), -s, s), wa = T(1.0) - s;
  const Quat<T> q = {fma(wa, a.w, wb * b.w), fma(wa, a.x, wb * b.x), fma(wa, a.y, wb * b.y),
                     fma(wa, a.z, wb * b.z)};
  const T r = T(1.0) / sqrt(fma(q.w, q.w, fma(q.x, q.x, fma(q.y, q.y, q.z * q.z))));
  return {r * q.w, r * q.x, r * q.y, r * q.z};
}

}  // namespace

template <class T>
MaskOf<T> advance_interval(const Model<RealOf<T>>& model, const IntervalInput<T>& input, State<T>& state,
                           Data<T>& d, Applied<T>* applied, const SubstepWatcher<T>& watch) {
  using Real = RealOf<T>;
  const auto& [from, to, substeps, assistance] = input;
  Target<T> target{};
  State<T> before;
  MaskOf<T> wrong = T(0.0) > T(1.0);
  for (int k = 1; k <= substeps; ++k) {
    const T s(static_cast<Real>(k) / static_cast<Real>(substeps));
    for (int i = 1; i < kBodies; ++i) {
      target.q[i] = interpolate(from.q[i], to.q[i], s);
      target.omega[i] = add_scaled(from.omega[i], s, to.omega[i] - from.omega[i]);
    }
    if (watch) before = state;
    wrong = wrong | step(model, target, state, d, applied, assistance);
    if (watch) watch(before, target, d, state);
  }
  return wrong;
}

#define MIMICX_INSTANTIATE(T)                                                                         \
  template MaskOf<T> advance_interval<T>(const Model<RealOf<T>>&, const IntervalInput<T>&, State<T>&, \
                                         Data<T>&, Applied<T>*, const SubstepWatcher<T>&);

MIMICX_FOR_ALL_SCALARS(MIMICX_INSTANTIATE)
#undef MIMICX_INSTANTIATE

}  // namespace mimicx::physics
