#include "files/recorded_forces.h"

#include "files/archive_members.h"

namespace mimicx::files {
namespace {

constexpr const char *kGround = "ground_wrenches", *kTorques = "joint_torques";

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

}  // namespace mimicx::files
