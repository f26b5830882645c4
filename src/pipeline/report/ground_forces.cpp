#include "pipeline/report/ground_forces.h"

#include "pipeline/output/floor_load.h"

namespace mimicx::pipeline::report {

GroundForces ground_forces(const PerBody<Vector6d>& wrenches, const BodyPoses& poses) {
  constexpr Array<output::Carrier, kGroundArrows> kOrder = {output::kOnLeftFoot, output::kOnRightFoot,
                                                            output::kOnTheRest};
  const auto loads = output::floor_wrenches(wrenches, poses.p_WB);
  GroundForces arrows;
  for (int k = 0; k < kGroundArrows; ++k) {
    const Vector6d& load = loads[kOrder[k]];
    if (load[5] >= output::kLeastLoad) arrows[k] = {output::centre_of_pressure(load), load.tail<3>()};
  }
  return arrows;
}

}  // namespace mimicx::pipeline::report
