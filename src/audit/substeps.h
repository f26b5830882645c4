/// `substeps/NAME.npz`: every physics step of a simulated motion, for an exact audit and for a replay.
///
/// The file holds everything that determines the simulation (body, scene, all simulation settings, the state
/// before each step and after the last one, the targets of the PD controllers) and the forces of each step.
/// Numbers are the simulator's own (float32), so that a replay starts from the same bits.
#pragma once

#include <filesystem>
#include <optional>

#include "physics/model.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::audit {

struct SubstepMotion {
  Character character;
  physics::SimulationConfig simulation;
  std::vector<rl::tracking::Substep> steps;
  motion::ReferenceFrame last;  ///< state after the last step
  Scene scene = {};             ///< the ground
  /// The character's joints where they are known; else they are those of its betas.
  std::optional<RestJoints> rest_joints = {};
};

void write_substeps(const std::filesystem::path& path, const SubstepMotion& motion);
/// Whether an archive has physics steps.
bool holds_substeps(const Npz& npz);
/// @throws DataError naming file and member
SubstepMotion read_substeps(const Npz& npz);

/// The motion replayed in double precision: each step starts from the recorded state before it and has the
/// recorded target. `next` are the states after the steps.
struct Replay {
  std::vector<rl::tracking::Substep> steps;
  std::vector<motion::ReferenceFrame> next;
};
Replay replay_in_double(const SubstepMotion& motion);

}  // namespace mimicx::audit
