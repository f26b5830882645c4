/// The PD target of an action a ∈ R⁵⁵: a rotation per joint, as a rotation vector for ball joints and an
/// angle about the axis for hinges.                                                 docs/method.md §4
///
/// Policies and plans share these functions, so that a plan replayed as actions gives the same bytes.
#pragma once

#include <algorithm>
#include <cmath>

#include "character/character.h"

namespace mimicx::physics {

/// The joint's rotation in an action. Entries beyond ± `limit` (rad) are clamped; non-finite entries count as
/// 0.
/// @param entry  maps a degree of freedom 0 … 54 to its entry
template <class Entry>
Vector3d action_rotation(int body, double limit, const Entry& entry) {
  const auto bounded = [&](int dof) {
    const double a = static_cast<double>(entry(dof));
    return std::isfinite(a) ? std::clamp(a, -limit, limit) : 0.0;
  };
  const int dof = first_dof(body);
  if (is_hinge(body)) return bounded(dof) * hinge_axis(body);
  return {bounded(dof), bounded(dof + 1), bounded(dof + 2)};
}

/// The target of a residual action: the reference's joint rotation, turned further in the child's frame.
inline Quaterniond residual_target(const Quaterniond& reference, const Vector3d& rotation) {
  return reference * exp_map(rotation);
}

}  // namespace mimicx::physics
