#include "run/run_messages.h"

#include <algorithm>
#include <cmath>

#include "core/number_text.h"
#include "core/quantile.h"
#include "judge/headline.h"
#include "record/progress.h"

namespace mimicx::run {
namespace {

constexpr std::size_t kFailuresNamed = 5;

/// "sliding 1.7 -> 0.2 mm a frame"; empty if neither value is visible.
std::string change(const judge::Headline& fault, double before, double after) {
  before *= fault.scale;
  after *= fault.scale;
  if (!std::isfinite(after)) return {};
  const bool known = std::isfinite(before);
  if (after < fault.visible && !(known && before >= fault.visible)) return {};
  if (known)
    return formatted("%s %.*f -> %.*f %s", fault.name, fault.decimals, before, fault.decimals, after,
                     fault.unit);
  return formatted("%s %.*f %s", fault.name, fault.decimals, after, fault.unit);
}

/// A metric of the successful entries. Empty if none has it.
std::vector<double> successes(const std::vector<record::SequenceEntry>& entries,
                              const NamedValues record::SequenceEntry::*values, const std::string& metric) {
  std::vector<double> out;
  for (const record::SequenceEntry& entry : entries) {
    const double value = value_of(entry.*values, metric);
    if (entry.ok && std::isfinite(value)) out.push_back(value);
  }
  return out;
}

/// The median, of an even number the mean of the two in the middle; NaN of none.
double middle(const std::vector<double>& values) {
  return values.empty() ? std::nan("") : 0.5 * (quantile(values, 0.5) + median(values));
}

std::string duration_of_motions(const std::vector<record::SequenceEntry>& entries) {
  double seconds = 0.0;
  for (const record::SequenceEntry& entry : entries)
    if (entry.fps > 0.0) seconds += entry.frames / entry.fps;
  return record::format_duration(seconds);
}

std::string failures(const std::vector<record::SequenceEntry>& entries) {
  std::string line;
  std::size_t failed = 0;
  for (const record::SequenceEntry& entry : entries)
    if (!entry.ok && failed++ < kFailuresNamed) line += (line.empty() ? "" : ", ") + entry.name;
  if (failed > kFailuresNamed) line += " and " + std::to_string(failed - kFailuresNamed) + " more";
  return line;
}

/// What ended the work, and how to continue.
std::string ended_by(const record::SequenceEntry& entry) {
  const std::string budget = entry.method == "imitate" ? "--samples" : "--budget-samples";
  switch (entry.ending) {
    case record::SequenceEnding::kBudget:
      return "the training spent its budget: with a larger " + budget + " than " +
             std::to_string(entry.samples) + " the same command continues it";
    case record::SequenceEnding::kLimitSeconds:
      return "the time limit ended it: with a larger --limit-seconds the same command continues";
    case record::SequenceEnding::kStall:
      return "the training stopped improving: another --seed starts a new one, in another folder";
    case record::SequenceEnding::kLost:
      if (entry.samples == 0) return "no policy was trained: mimicx adapt trains policies where a plan fails";
      if (!entry.spent_its_budget())
        return "neither a plan nor policies could follow, and more samples do not continue this training: "
               "another --seed starts a new one, in another folder";
      return "neither a plan nor policies could follow: with a larger --budget-samples than " +
             std::to_string(entry.samples) + " the same command continues the training";
    default:
      return "";
  }
}

}  // namespace

std::string result_line(const record::SequenceEntry& entry) {
  std::string line = entry.name + ": " + (entry.ok ? "ok" : "failed");
  if (!entry.reason.empty()) line += ", " + entry.reason;
  const double distance = value_of(entry.metrics, "gMPJPE");
  if (std::isfinite(distance)) line += formatted(", %.1f mm from the reference", distance);
  for (const judge::Headline& fault : judge::kHeadlines) {
    if (!fault.always) continue;
    const std::string words =
        change(fault, value_of(entry.input_metrics, fault.metric), value_of(entry.metrics, fault.metric));
    if (entry.ok && !words.empty()) line += ", " + words;
  }
  const char* before = "; worse than the input: ";
  for (const record::Worsening& worse : entry.worse) {
    const bool told = std::any_of(judge::kHeadlines.begin(), judge::kHeadlines.end(),
                                  [&](const auto& h) { return h.always && worse.measure == h.name; });
    line += before + worse.measure + (told ? "" : " " + worse.numbers) + " (" + worse.why + ")";
    before = ", ";
  }
  return line;
}

std::vector<std::string> summary(const std::vector<record::SequenceEntry>& entries, double seconds,
                                 const std::string& next) {
  const auto done = std::count_if(entries.begin(), entries.end(), [](const auto& entry) { return entry.ok; });
  std::vector<std::string> lines = {std::to_string(done) + " of " + std::to_string(entries.size()) +
                                    " motions are ok: " + duration_of_motions(entries) + " of motion in " +
                                    record::format_duration(seconds)};
  const std::vector<double> distances = successes(entries, &record::SequenceEntry::metrics, "gMPJPE");
  if (!distances.empty())
    lines.push_back(formatted("  in the median %.1f mm from the reference, ", middle(distances)) +
                    formatted("at most %.1f mm", *std::max_element(distances.begin(), distances.end())));
  for (const judge::Headline& fault : judge::kHeadlines) {
    if (!fault.always) continue;
    const std::string words =
        change(fault, middle(successes(entries, &record::SequenceEntry::input_metrics, fault.metric)),
               middle(successes(entries, &record::SequenceEntry::metrics, fault.metric)));
    if (!words.empty()) lines.push_back("  " + words);
  }
  const std::string failed = failures(entries);
  if (!failed.empty()) lines.push_back("  failed: " + failed);
  lines.push_back("  " + next);
  return lines;
}

std::vector<std::string> what_next(const record::SequenceEntry& entry, const record::RunFolder& folder) {
  if (entry.ok || entry.output.empty()) return {};
  std::vector<std::string> lines = {"rejected motion: " + (folder.root / entry.output).string() +
                                    "; beside its reference in " + folder.report().string()};
  if (!entry.parts.empty()) lines.push_back(parts_in_words(entry));
  if (const std::string ended = ended_by(entry); !ended.empty()) lines.push_back(ended);
  if (entry.ending != record::SequenceEnding::kLimitSeconds &&
      value_of(entry.feasibility, "infeasible_share") > 0.0)
    lines.push_back("parts of the reference are not feasible for any body: mimicx audit --poses '" +
                    folder.reference(entry.name).string() +
                    "' --frames-csv frames.csv lists the frames; remove or correct them");
  return lines;
}

}  // namespace mimicx::run
