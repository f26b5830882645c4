/// policies/NAME.npz: a policy that follows one motion, with everything that is needed to run it.
///                                                                                       docs/formats.md
///
/// The file is also a motion file: it holds the motion that the policy follows, with its body. It adds the
/// exact states of that motion, the settings of the simulation, and the networks.
#pragma once

#include <filesystem>

#include "core/npz/npz.h"
#include "motion/clip.h"
#include "physics/model.h"
#include "rl/policy.h"
#include "rl/tracking/tracking_clip.h"

namespace mimicx::files {

struct StoredPolicy {
  motion::Reference motion;              ///< that the policy follows: name, rate, body
  List<physics::State<double>> states;   ///< [frames] of that motion, in the simulator's numbers
  physics::SimulationConfig simulation;  ///< in which the policy acts
  rl::tracking::ActionSettings actions;  ///< what its actions mean
  rl::Agent agent;

  /// The tracking task in which it acts.
  rl::tracking::TrackingConfig task() const;
};

/// @param input  the motion whose body is written
void write_policy(const std::filesystem::path& path, const motion::Clip& input, const StoredPolicy& stored);
/// @throws DataError naming file and member that is missing or of another shape
StoredPolicy read_policy(const std::filesystem::path& path);
StoredPolicy policy_from(const Npz& npz);

}  // namespace mimicx::files
