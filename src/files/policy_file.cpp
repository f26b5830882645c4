#include "files/policy_file.h"

#include <stdexcept>

#include "core/setting.h"
#include "files/archive_members.h"
#include "files/simulation_settings.h"
#include "motion/clip_file.h"

namespace mimicx::files {
namespace {

constexpr const char* kAgentPrefix = "policy.";
constexpr const char* kStatePrefix = "state_";

/// Adds the settings of the actions that are not the default.
void add_actions(const rl::tracking::ActionSettings& actions, Npz& npz) {
  const NamedValues usual = settings_of(rl::tracking::ActionSettings{}), own = settings_of(actions);
  for (std::size_t k = 0; k < own.size(); ++k)
    if (own[k].second != usual[k].second) npz.set(own[k].first, NpyArray::from_double({1}, &own[k].second));
}

rl::tracking::ActionSettings read_actions(const Npz& npz) {
  rl::tracking::ActionSettings actions;
  try {
    for (const auto& [name, usual] : settings_of(actions))
      if (npz.has(name)) apply_setting(actions, name, read_number(npz, name));
    require_ranges(actions);
  } catch (const std::invalid_argument& error) {
    throw DataError(npz.path, "", "the settings of actions", error.what());
  }
  return actions;
}

}  // namespace

rl::tracking::TrackingConfig StoredPolicy::task() const {
  rl::tracking::TrackingConfig config;
  config.simulation = simulation;
  config.actions = actions;
  return config;
}

void write_policy(const std::filesystem::path& path, const motion::Clip& input, const StoredPolicy& stored) {
  Npz npz = motion::to_npz(motion::clip_on_body_of(input, stored.motion, stored.motion.frames));
  add_states(kStatePrefix, stored.states, Precision::kFloat32, npz);
  for (const auto& [name, number] : simulation_numbers(stored.simulation))
    npz.set(name, NpyArray::from_double({1}, &number));
  add_actions(stored.actions, npz);
  rl::save(npz, kAgentPrefix, stored.agent);
  write_npz(path, npz);
}

StoredPolicy read_policy(const std::filesystem::path& path) { return policy_from(read_npz(path)); }

StoredPolicy policy_from(const Npz& npz) {
  const motion::Clip clip = motion::clip_from(npz, std::filesystem::path(npz.path).stem().string());
  StoredPolicy stored;
  stored.states = read_states(npz, kStatePrefix);
  stored.simulation = read_simulation(npz);
  stored.actions = read_actions(npz);
  motion::Reference body;
  body.name = clip.name;
  body.fps = clip.fps;
  body.character = motion::character_of(clip);
  body.scene = clip.scene;
  stored.motion = rl::tracking::reference_of_states(body, stored.states);
  stored.agent = rl::load_agent(npz, kAgentPrefix);
  if (stored.agent.actor.inputs() != rl::tracking::kStateSize || stored.agent.actor.outputs() != kDofs)
    throw DataError(
        npz.path, "policy.actor", "a network from 570 to 55 numbers",
        std::to_string(stored.agent.actor.inputs()) + " to " + std::to_string(stored.agent.actor.outputs()));
  return stored;
}

}  // namespace mimicx::files
