#include "audit/friction_cones.h"

#include <cmath>
#include <numbers>

#include "audit/non_negative_least_squares.h"
#include "core/elementary.h"

namespace mimicx::audit {

Vector6d fit_cone_forces(const Floor& floor, const Vector3d& center, const Vector6d& wanted,
                         List<Push>& pushes, const List<double>& prices) {
  if (pushes.empty()) return wanted;
  List<Vector3d> edges;
  for (int k = 0; k < floor.edges; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / floor.edges;
    edges.emplace_back(floor.friction * cos(angle), floor.friction * sin(angle), 1.0);
  }
  // In units in which every push has the price 1.
  const auto unit = [&](int i) { return prices.empty() ? 1.0 : 1.0 / std::sqrt(prices[i]); };
  Matrix6X A(6, floor.edges * pushes.count());
  for (int i = 0; i < pushes.count(); ++i)
    for (int k = 0; k < floor.edges; ++k) {
      const Vector3d moment = (pushes[i].p - center).cross(edges[k]);
      for (int axis = 0; axis < 3; ++axis) {
        A(axis, floor.edges * i + k) = unit(i) * moment[axis];
        A(3 + axis, floor.edges * i + k) = unit(i) * edges[k][axis];
      }
    }
  const Eigen::VectorXd x = non_negative_least_squares(A, wanted, floor.small_forces);
  for (int i = 0; i < pushes.count(); ++i)
    for (int k = 0; k < floor.edges; ++k) pushes[i].force += unit(i) * x[floor.edges * i + k] * edges[k];
  return wanted - A * x;
}

}  // namespace mimicx::audit
