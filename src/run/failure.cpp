#include "run/failure.h"

namespace mimicx::run {
namespace {

/// What ended the work, and what to do about that.
std::string ended_by(const record::SequenceEntry& entry) {
  const std::string budget = entry.method == "imitate" ? "--samples" : "--budget-samples";
  switch (entry.ending) {
    case record::Ending::kBudget:
      return "the training ended with its budget: with a larger " + budget + " than " +
             std::to_string(entry.samples) + " the same command goes on from here";
    case record::Ending::kLimitSeconds:
      return "the time limit ended it: with a larger --limit-seconds the same command goes on";
    case record::Ending::kStall:
      return "the training no longer became better: another --seed begins it anew, in another folder";
    case record::Ending::kLost:
      if (entry.samples == 0) return "no policy was trained: mimicx adapt does so where a plan is lost";
      return "neither a plan nor policies could follow: a larger --budget-samples than " +
             std::to_string(entry.samples) + " goes on with the policies";
    default:
      return "";
  }
}

}  // namespace

std::vector<std::string> what_next(const record::SequenceEntry& entry, const record::RunFolder& folder) {
  if (entry.ok || entry.output.empty()) return {};
  std::vector<std::string> lines = {"rejected motion: " + (folder.root / entry.output).string() +
                                    "; beside its reference in " + folder.report().string()};
  double infeasible = 0.0;
  for (const auto& [name, value] : entry.feasibility)
    if (name == "infeasible_share") infeasible = value;
  if (const std::string ended = ended_by(entry); !ended.empty()) lines.push_back(ended);
  if (infeasible > 0.0)
    lines.push_back("no body can do all of it: mimicx audit --poses '" + entry.input +
                    "' --frames-csv frames.csv says which frames; leave these out, or correct them");
  return lines;
}

}  // namespace mimicx::run
