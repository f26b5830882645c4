#include "report/ground_forces.h"

#include "files/floor_load.h"

namespace mimicx::report {

GroundForces ground_forces(const PerBody<Vector6d>& wrenches, const BodyPoses& poses) {
  constexpr Array<files::Carrier, kGroundArrows> kOrder = {files::kOnLeftFoot, files::kOnRightFoot,
                                                           files::kOnTheRest};
  const auto loads = files::floor_wrenches(wrenches, poses.p_WB);
  GroundForces arrows;
  for (int k = 0; k < kGroundArrows; ++k) {
    const Vector6d& load = loads[kOrder[k]];
    if (load[5] >= files::kLeastLoad) arrows[k] = {files::centre_of_pressure(load), load.tail<3>()};
  }
  return arrows;
}

}  // namespace mimicx::report
