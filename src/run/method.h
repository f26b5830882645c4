/// A method of simulating motions (`Method`), its input for one motion (`SequenceJob`), and its result
/// (`SimulatedSequence`).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "audit/pose_needs.h"
#include "control/plan_control.h"
#include "core/containers.h"
#include "core/named_values.h"
#include "files/policy_file.h"
#include "record/progress.h"
#include "record/run_folder.h"
#include "record/sequence_entry.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::run {

/// One motion of a run, for the method that simulates it.
struct SequenceJob {
  std::string name;            ///< key of the sequence's files in the folder
  std::string input_checksum;  ///< a checkpoint of another input is not continued
  record::RunFolder folder;
  bool substeps = false;  ///< record every physics step of the result; else none
  bool gains = false;     ///< write the feedback gains of a plan
  int threads = 1;
  double limit_seconds = 0.0;     ///< time limit; 0: none
  const audit::PoseNeeds& needs;  ///< of the reference; without frames under 3
  const record::RunContext& context;
};

/// The job with its time limit reduced by the seconds that were spent.
inline SequenceJob after_seconds(SequenceJob job, double seconds) {
  if (job.limit_seconds > 0.0) job.limit_seconds = std::max(job.limit_seconds - seconds, 1e-9);
  return job;
}

/// Decides when planning or training of one motion stops, and records why. Must outlive every control that it
/// returned, at the same address.
struct JobWatch {
  const SequenceJob& job;
  double started = record::steady_seconds();
  bool interrupted = false;  ///< the context asked to stop
  bool timed_out = false;    ///< the job's seconds ran out

  control::PlanControl control() {
    control::PlanControl control;
    control.threads = job.threads;
    control.should_stop = [this] {
      interrupted = interrupted || job.context.should_stop();
      timed_out = job.limit_seconds > 0.0 && record::steady_seconds() - started > job.limit_seconds;
      return interrupted || timed_out;
    };
    return control;
  }
};

/// The result of a method for one motion.
struct SimulatedSequence {
  bool interrupted = false;  ///< the job's context requested a stop: only the seconds below are set
  std::string method;        ///< that made the result: imitate, plan, options or printed
  double planning_seconds = 0.0, training_seconds = 0.0;  ///< for timing.json
  record::SequenceEnding ending = record::SequenceEnding::kNone;
  std::int64_t samples = 0;
  std::int64_t begun_samples = 0;  ///< budget that the training began with, if it was smaller; else 0
  /// How a training ended before its budget, if the result is a plan; else kNone.
  record::SequenceEnding training_ending = record::SequenceEnding::kNone;
  std::optional<rl::tracking::TrackingRollout> before;  ///< of the agents before training; a plan has none
  rl::tracking::TrackingRollout after;                  ///< the result
  std::vector<std::array<int, 2>> arrangement = {};     ///< {first frame, option of all sets}; else empty
  NamedValues plan = {};                                ///< how it was planned
  NamedValues policy = {};  ///< how well the policy acts that the plan taught; or empty
  std::optional<files::StoredPolicy> taught = {};  ///< that policy, for the run to write
  std::vector<rl::Agent> agents = {};              ///< of a training
  /// Remaining assistive moment and force of a plan's assisted stage; or empty.
  PerFrame<Vector6d> assistance = {};
  std::string reason = {};              ///< why it is no success, or may be none, if the method knows
  std::vector<std::string> notes = {};  ///< for the manifest
};

/// A stretch of a motion that failed as a whole (`Method::parts`).
struct FollowedPart {
  int first = 0;                ///< frame of the whole reference
  motion::Reference reference;  ///< its frames
  rl::tracking::TrackingRollout rollout;
};

struct FollowedParts {
  List<FollowedPart> parts;  ///< at most record::kMostParts, in the order of time
  bool interrupted = false;  ///< the job's context requested a stop: the parts are incomplete
  bool timed_out = false;    ///< the same of the job's seconds
  double seconds = 0.0;
};

/// A way to make the humanoid follow a motion, with everything that its results depend on.
struct Method {
  std::string name;  ///< imitate, plan, options, printed or auto
  std::uint64_t seed = 0;
  std::int64_t samples = 0;              ///< budget per motion
  NamedValues settings;                  ///< as the manifest lists them, including those of the RunConfig
  std::string options;                   ///< checksums of the trained options; empty without
  physics::SimulationConfig simulation;  ///< under which it simulates, for the audit
  std::function<SimulatedSequence(const motion::Reference&, const SequenceJob&)> simulate;
  /// What can be followed of a motion whose result, the roll-out, is no success; may be empty.
  std::function<FollowedParts(const motion::Reference&, const rl::tracking::TrackingRollout&,
                              const SequenceJob&)>
      parts = {};
};

}  // namespace mimicx::run
