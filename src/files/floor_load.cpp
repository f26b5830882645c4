#include "files/floor_load.h"

namespace mimicx::files {

Carrier carrier_of(int body) {
  if (body == kRightAnkle || body == kRightFoot) return kOnRightFoot;
  return body == kLeftAnkle || body == kLeftFoot ? kOnLeftFoot : kOnTheRest;
}

Array<Vector6d, kCarriers> floor_wrenches(const PerBody<Vector6d>& wrenches,
                                          const PerBody<Vector3d>& joints) {
  Array<Vector6d, kCarriers> sums;
  sums.fill(Vector6d::Zero());
  for (int b = 0; b < kBodies; ++b) {
    const Vector3d force = wrenches[b].tail<3>();
    Vector6d& sum = sums[carrier_of(b)];
    sum.head<3>() += wrenches[b].head<3>() + joints[b].cross(force);
    sum.tail<3>() += force;
  }
  return sums;
}

Vector3d centre_of_pressure(const Vector6d& wrench) {
  return {-wrench[1] / wrench[5], wrench[0] / wrench[5], 0.0};
}

}  // namespace mimicx::files
