/// What a run records of a motion, and the same as JSON for the manifest and the journal.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/named_values.h"
#include "record/json.h"

namespace mimicx::record {

/// Names of files in the folder of a run, with their checksums (`file_checksum`).
using FileChecksums = std::vector<std::pair<std::string, std::string>>;

/// How the work on a motion ended.
enum class SequenceEnding {
  kNone,          ///< the input could not be used
  kBudget,        ///< all samples were spent
  kThreshold,     ///< a roll-out was good enough
  kStall,         ///< roll-outs stopped improving
  kLimitSeconds,  ///< the time limit: the results depend on the machine's speed
  kFollowed,      ///< a plan that reaches the motion's end
  kLost,          ///< a plan that does not
};

/// A measure in which the result is worse than the input (judge/worsening.h).
struct Worsening {
  std::string measure;                     ///< "sliding"
  std::string numbers;                     ///< "0.4 -> 0.9 mm a frame"
  std::vector<std::array<int, 2>> frames;  ///< first and last of the stretches with the most of it
  std::string why;                         ///< "its reference slides, too"
};
/// "sliding 0.4 -> 0.9 mm a frame, most at frames 31-40, 77: its reference slides, too"
std::string in_words(const Worsening& worsening);

struct SequenceEntry {
  std::string name;            ///< key of the sequence's files in the folder
  std::string input;           ///< as given on the command line
  std::string input_checksum;  ///< of the input's bytes; empty when it could not be read
  std::string output;          ///< relative to the folder; empty when there is none
  FileChecksums files;         ///< that the sequence left, to detect missing and changed ones
  bool ok = false;
  std::string reason;  ///< why it failed
  /// {first, last} frame of every part that was followed (RunFolder::part, from 1 on); empty for a success.
  std::vector<std::array<int, 2>> parts;
  std::string method;  ///< what made the motion: imitate, plan, policy, options or printed
  SequenceEnding ending = SequenceEnding::kNone;
  int frames = 0;
  double fps = 0.0;
  std::uint64_t seed = 0;
  std::int64_t samples = 0;
  /// Mean reward per frame (not softened) of the mean-action roll-out, before and after training.
  double reward_before = std::numeric_limits<double>::quiet_NaN();
  double reward_after = std::numeric_limits<double>::quiet_NaN();
  /// {first frame, option} of every stretch of one option; empty for a training from scratch.
  std::vector<std::array<int, 2>> arrangement;
  NamedValues plan;              ///< how it was planned; empty where nothing was planned
  NamedValues policy;            ///< how the plan taught a policy, and how well that acts unaided; or empty
  NamedValues fit;               ///< what the keypoint fit did; empty without one
  NamedValues input_metrics;     ///< of the unprepared input, against the prepared reference
  NamedValues metrics;           ///< of the simulated motion, against the prepared reference
  std::vector<Worsening> worse;  ///< measures in which a success is worse than its input
  NamedValues metrics_before;    ///< of the simulated motion before training
  bool ok_before = false;        ///< whether the motion was a success before training
  NamedValues audit;             ///< of the simulated motion: forces that remain unexplained (audit.h)
  NamedValues preparation;       ///< what preparation did to the input
  /// What the prepared reference needs from outside (audit/pose_verdict.h); empty under 3 frames.
  NamedValues feasibility;
  std::vector<std::string> decisions;  ///< what reading the input decided
  std::vector<std::string> notes;
  /// How a training beside a plan that was written ended, if it ended before its budget; else kNone.
  SequenceEnding training_ending = SequenceEnding::kNone;

  /// Whether the same command keeps this result instead of repeating the work.
  bool finished() const { return !output.empty() && ending != SequenceEnding::kLimitSeconds; }

  /// Whether a larger budget continues its training: all samples were spent. A training that reached its
  /// threshold or stalled is finished, whatever the budget.
  bool spent_its_budget() const;
};

/// "followed in part, as motions of their own: frames 0-60 in motions/walk.part1.npz, …"; empty without parts
std::string parts_in_words(const SequenceEntry& entry);

Json to_json(const SequenceEntry& entry);
/// @throws JsonError
SequenceEntry entry_of(const Json& json);

}  // namespace mimicx::record
