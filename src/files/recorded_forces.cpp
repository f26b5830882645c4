#include "files/recorded_forces.h"

#include "files/simulated_members.h"

namespace mimicx::files {
namespace {

constexpr const char *kGround = "ground_wrenches", *kTorques = "joint_torques";

/// Where the floor is under a carrier: below the middle of its foot, or the pelvis.
Vector3d under(Carrier carrier, const PerBody<Vector3d>& joints) {
  Vector3d p = carrier == kOnTheRest     ? joints[kPelvis]
               : carrier == kOnRightFoot ? Vector3d(0.5 * (joints[kRightAnkle] + joints[kRightFoot]))
                                         : Vector3d(0.5 * (joints[kLeftAnkle] + joints[kLeftFoot]));
  p.z() = 0.0;
  return p;
}

/// @param wrench  moment about the world's origin, and force
FloorForce floor_force(const Vector6d& wrench, const Vector3d& under) {
  const Vector3d moment = wrench.head<3>();
  FloorForce out;
  out.force = wrench.tail<3>();
  out.loaded = out.force.z() >= kLeastLoad;
  // moment = point × force + free_moment · z has this one solution with z = 0.
  out.point = out.loaded ? centre_of_pressure(wrench) : under;
  out.free_moment = (moment - out.point.cross(out.force)).z();
  return out;
}

}  // namespace

std::optional<RecordedForces> recorded_forces(const motion::Clip& clip) {
  Npz npz;
  npz.path = clip.name;
  for (const auto& [name, array] : clip.passthrough)
    if (name == kGround || name == kTorques) npz.set(name, array);
  if (npz.members().empty()) return std::nullopt;
  const auto rows = static_cast<std::size_t>(clip.frames());
  const WrenchRows ground = read_wrenches(npz, kGround, rows);
  const VectorRows torques = read_joints(npz, kTorques, rows);
  return RecordedForces{{ground}, {torques}};
}

List<FloorForces> floor_forces(const PerFrame<BodyPoses>& poses, const RecordedForces& forces) {
  List<FloorForces> out;
  for (int t = 1; t < poses.count(); ++t) {
    PerBody<Vector3d> joints;
    for (int b = 0; b < kBodies; ++b) joints[b] = 0.5 * (poses[t - 1].p_WB[b] + poses[t].p_WB[b]);
    const Array<Vector6d, kCarriers> wrench = floor_wrenches(forces.ground[t], joints);
    FloorForces row;
    for (const Carrier c : {kOnRightFoot, kOnLeftFoot, kOnTheRest})
      row[c] = floor_force(wrench[c], under(c, joints));
    out.push_back(row);
  }
  return out;
}

}  // namespace mimicx::files
