#include "files/floor_forces.h"

namespace mimicx::files {
namespace {

/// @param wrench  moment about the world's origin, and force
FloorForce floor_force(const Vector6d& wrench, const Vector3d& under) {
  const Vector3d moment = wrench.head<3>();
  FloorForce out;
  out.force = wrench.tail<3>();
  out.loaded = out.force.z() >= kLeastLoad;
  // moment = point × force + free_moment · z has this one solution at the height of the ground.
  out.point = out.loaded ? centre_of_pressure(wrench, under.z()) : under;
  out.free_moment = (moment - out.point.cross(out.force)).z();
  return out;
}

}  // namespace

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

Vector3d centre_of_pressure(const Vector6d& wrench, double height) {
  return {(-wrench[1] + height * wrench[3]) / wrench[5], (wrench[0] + height * wrench[4]) / wrench[5],
          height};
}

Vector3d ground_under(Carrier carrier, const PerBody<Vector3d>& joints, const Scene& scene) {
  Vector3d p = carrier == kOnTheRest     ? joints[kPelvis]
               : carrier == kOnRightFoot ? Vector3d(0.5 * (joints[kRightAnkle] + joints[kRightFoot]))
                                         : Vector3d(0.5 * (joints[kLeftAnkle] + joints[kLeftFoot]));
  p.z() = scene.height_under(p);
  return p;
}

List<FloorForces> floor_forces(const PerFrame<BodyPoses>& poses, const RecordedForces& forces,
                               const Scene& scene) {
  List<FloorForces> out;
  for (int t = 1; t < poses.count(); ++t) {
    PerBody<Vector3d> joints;
    for (int b = 0; b < kBodies; ++b) joints[b] = 0.5 * (poses[t - 1].p_WB[b] + poses[t].p_WB[b]);
    const Array<Vector6d, kCarriers> wrench = floor_wrenches(forces.ground[t], joints);
    FloorForces row;
    for (const Carrier c : {kOnRightFoot, kOnLeftFoot, kOnTheRest})
      row[c] = floor_force(wrench[c], ground_under(c, joints, scene));
    out.push_back(row);
  }
  return out;
}

FloorArrows floor_arrows(const PerBody<Vector6d>& wrenches, const BodyPoses& poses, const Scene& scene) {
  constexpr Array<Carrier, kCarriers> kOrder = {kOnLeftFoot, kOnRightFoot, kOnTheRest};
  const auto loads = floor_wrenches(wrenches, poses.p_WB);
  FloorArrows arrows;
  for (int k = 0; k < kCarriers; ++k) {
    const Vector6d& load = loads[kOrder[k]];
    if (load[5] >= kLeastLoad)
      arrows[k] = {centre_of_pressure(load, ground_under(kOrder[k], poses.p_WB, scene).z()), load.tail<3>()};
  }
  return arrows;
}

}  // namespace mimicx::files
