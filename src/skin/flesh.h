/// The mannequin as a solid: a signed distance, negative inside.
///
/// Every body of the character gets tapered shapes whose lengths and radii follow from its own capsules and
/// joints, so the mannequin has the proportions, the girth and the soles of the body that is simulated.
/// Strings of such shapes (a leg from hip to ankle, the trunk from pelvis to chest) swell and taper along a
/// spline. A smooth minimum blends the strings of a limb, and each limb with the trunk, but never two limbs.
/// (I. Quilez, "Smooth minimum", the quadratic one.)
///
/// Soles are flat: a foot is cut off at the height at which the character stands.
///
/// Distances are accurate enough to find the surface, not exact: shapes are tapered and squeezed.
#pragma once

#include <vector>

#include "skin/modelling.h"

namespace mimicx::skin {

class Flesh {
 public:
  explicit Flesh(const Character& character);

  /// Signed distance to the surface, bind pose, m.
  double distance(const Vector3d& p) const;
  /// Outward unit normal at p of the level surface of the distance through p.
  Vector3d normal(const Vector3d& p) const;
  /// The nearest point of the surface, by Newton's method along the normal.
  Vector3d on_surface(Vector3d p) const;
  /// Distance to the shapes of one body alone.
  double distance_to(int body, const Vector3d& p) const;

  /// A box that contains the mannequin.
  Eigen::AlignedBox3d bounds() const;

 private:
  std::vector<Chain> chains_;                 ///< limb by limb
  Array<double, kLimbs> sole_;                ///< legs are cut off at this height, m
  Array<Eigen::AlignedBox3d, kLimbs> boxes_;  ///< of the limbs
};

}  // namespace mimicx::skin
