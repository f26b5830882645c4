/// What a method of simulating motions hands back to the run.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/containers.h"
#include "core/named_values.h"
#include "files/policy_file.h"
#include "record/ending.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::run {

/// What a method made of one motion.
struct SimulatedSequence {
  bool interrupted = false;  ///< the job's context asked to stop: only the seconds below are filled
  std::string method;        ///< what made the result: imitate, plan or paper
  double planning_seconds = 0.0, training_seconds = 0.0;  ///< for timing.json
  record::Ending ending = record::Ending::kNone;
  std::int64_t samples = 0;
  std::optional<rl::tracking::TrackingRollout> before;  ///< of the agents before training; a plan has none
  rl::tracking::TrackingRollout after;                  ///< the result
  std::vector<std::array<int, 2>> arrangement = {};     ///< {first frame, option of all sets}; else empty
  NamedValues plan = {};                                ///< what planning it took
  NamedValues policy = {};                         ///< how the policy does that the plan has taught; or none
  std::optional<files::StoredPolicy> taught = {};  ///< that policy, to be written
  std::vector<rl::Agent> agents = {};              ///< of a training
  PerFrame<Vector6d> help = {};         ///< moment and force that a plan's soft stage was left with; or none
  std::string reason = {};              ///< why it is no success, or may be none, where the method knows
  std::vector<std::string> notes = {};  ///< for the manifest
};

}  // namespace mimicx::run
