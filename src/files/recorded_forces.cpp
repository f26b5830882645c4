#include "files/recorded_forces.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/containers.h"
#include "core/units.h"
#include "files/archive_members.h"

namespace mimicx::files {
namespace {

constexpr const char *kGround = "ground_wrenches", *kTorques = "joint_torques", *kWeight = "body_weight",
                     *kFriction = "friction", *kRate = "physics_rate";
constexpr Array<std::string_view, 12> kRecorded = {
    "joints",           "velocities",      "joint_torques",
    "range_torques",    "ground_wrenches", "self_contact_wrenches",
    "foot_force_least", "foot_force_most", "foot_force_least_effort",
    "body_weight",      "friction",        "physics_rate"};

/// Whether a row of the member has the shape of ours; the number of rows may be wrong.
bool has_our_rows(const NpyArray& array, const std::vector<std::size_t>& row) {
  return array.type != NpyArray::Type::kText && array.shape.size() == row.size() + 1 &&
         std::equal(row.begin(), row.end(), array.shape.begin() + 1);
}

}  // namespace

std::optional<RecordedForces> recorded_forces(const motion::Clip& clip, const std::string& file) {
  if (!clip.has_simulated_body()) return std::nullopt;
  Npz npz;
  npz.path = file.empty() ? clip.name : file;
  for (const auto& [name, array] : clip.passthrough) {
    if (name != kGround && name != kTorques) continue;
    const bool ours = has_our_rows(
        array, name == kGround ? std::vector<std::size_t>{kBodies, 6} : std::vector<std::size_t>{kDofs});
    if (!ours) return std::nullopt;  // another program's
    npz.set(name, array);
  }
  if (npz.members().empty()) return std::nullopt;
  const auto rows = static_cast<std::size_t>(clip.frames());
  const WrenchRows ground = read_wrenches(npz, kGround, rows);
  const VectorRows torques = read_joints(npz, kTorques, rows);
  return RecordedForces{{ground}, {torques}};
}

double recorded_gravity(const motion::Clip& clip) {
  constexpr double kRounding = 1e-6;  // of the file's numbers, relative
  if (!clip.has_simulated_body()) return kGravity;
  for (const auto& [name, array] : clip.passthrough) {
    if (name != kWeight || array.size() != 1 || array.type == NpyArray::Type::kText) continue;
    const double gravity = array.to_double().front() / motion::character_of(clip).total_mass();
    if (!std::isfinite(gravity) || gravity <= 0.0) continue;  // of another program
    return std::abs(gravity - kGravity) < kRounding * kGravity ? kGravity : gravity;
  }
  return kGravity;
}

physics::SimulationConfig recorded_simulation(const motion::Clip& clip) {
  physics::SimulationConfig simulation;
  if (!clip.has_simulated_body()) return simulation;
  simulation.gravity = recorded_gravity(clip);
  for (const auto& [name, array] : clip.passthrough) {
    if ((name != kFriction && name != kRate) || array.size() != 1 || array.type == NpyArray::Type::kText)
      continue;
    const double value = array.to_double().front();
    if (!std::isfinite(value) || value < (name == kRate ? 1.0 : 0.0)) continue;  // of another program
    (name == kRate ? simulation.rate : simulation.friction) = value;
  }
  return simulation;
}

Members simulation_members(const physics::SimulationConfig& simulation, double mass) {
  const physics::SimulationConfig usual;
  Members members = {{kWeight, NpyArray::scalar(simulation.gravity * mass)}};
  if (simulation.friction != usual.friction)
    members.emplace_back(kFriction, NpyArray::scalar(simulation.friction));
  if (simulation.rate != usual.rate) members.emplace_back(kRate, NpyArray::scalar(simulation.rate));
  return members;
}

bool remove_recorded(motion::Clip& clip) {
  return std::erase_if(clip.passthrough, [](const auto& member) {
           return std::find(kRecorded.begin(), kRecorded.end(), member.first) != kRecorded.end();
         }) > 0;
}

std::string other_reading(const motion::Clip& clip, const import::ReadConfig& read) {
  if (clip.as_recorded) return "";
  return "one that is read with other options than it was simulated with (" + read.text() + ")";
}

}  // namespace mimicx::files
