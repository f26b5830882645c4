#include "pipeline/report/ground_forces.h"

namespace mimicx::pipeline::report {
namespace {

constexpr double kLeastPush = 1.0;  ///< N; under it a centre of pressure means nothing

int arrow_of(int body) {
  if (body == kLeftAnkle || body == kLeftFoot) return 0;
  if (body == kRightAnkle || body == kRightFoot) return 1;
  return 2;
}

}  // namespace

GroundForces ground_forces(const PerBody<Vector6d>& wrenches, const BodyPoses& poses) {
  Array<Vector6d, kGroundArrows> sums;
  sums.fill(Vector6d::Zero());
  for (int i = 0; i < kBodies; ++i) {
    const Vector3d force = wrenches[i].tail<3>();
    sums[arrow_of(i)].tail<3>() += force;
    sums[arrow_of(i)].head<3>() += wrenches[i].head<3>() + poses.p_WB[i].cross(force);
  }
  GroundForces arrows;
  for (int k = 0; k < kGroundArrows; ++k) {
    const Vector3d n = sums[k].head<3>(), f = sums[k].tail<3>();
    if (f.z() < kLeastPush) continue;
    arrows[k] = {Vector3d(-n.y() / f.z(), n.x() / f.z(), 0.0), f};
  }
  return arrows;
}

}  // namespace mimicx::pipeline::report
