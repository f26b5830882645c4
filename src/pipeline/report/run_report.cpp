#include "pipeline/report/run_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <utility>

#include "core/npz.h"
#include "core/units.h"
#include "motion/clip_file.h"
#include "motion/metrics.h"
#include "pipeline/record/feasibility_file.h"
#include "pipeline/record/table.h"
#include "pipeline/report/report.h"

namespace mimicx::pipeline::report {
namespace {

/// Motions that one page holds: each takes a tenth of a megabyte per hundred frames.
constexpr std::size_t kMostShown = 200;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string with_unit(const std::string& metric) {
  for (const auto& d : motion::metric_definitions())
    if (metric == d.name) return metric + ", " + d.unit;
  return metric;
}

/// "preparation: floor shift 0.32 mm" of floor_shift_mm: names in records have their unit last.
std::string note_of(const std::string& step, const std::pair<std::string, double>& value) {
  static const std::map<std::string, std::string> kUnits = {
      {"mm", "mm"}, {"deg", "degrees"}, {"N", "N"}, {"Nm", "N m"}, {"J", "J"}, {"percent", "%"}};
  std::string words = value.first, unit;
  const std::size_t last = words.rfind('_');
  if (const auto found = kUnits.find(words.substr(last + 1));
      last != std::string::npos && found != kUnits.end()) {
    unit = " " + found->second;
    words.resize(last);
  }
  if (words.ends_with("_worst")) words.replace(words.size() - 6, 6, "_largest at frame");
  std::replace(words.begin(), words.end(), '_', ' ');
  const bool whole = unit.empty() && value.second == std::trunc(value.second);
  char text[32];
  std::snprintf(text, sizeof text, whole ? " %.0f" : " %.2f", value.second);
  return step + ": " + words + text + unit;
}

/// "options: 1 from frame 0, 3 from frame 42"
std::string arrangement_note(const std::vector<std::array<int, 2>>& arrangement) {
  std::string text = "options:";
  for (const auto& [frame, option] : arrangement)
    text +=
        (text.back() == ':' ? " " : ", ") + std::to_string(option) + " from frame " + std::to_string(frame);
  return text;
}

/// A row per metric: those of the last column in its order, then those that only other columns have.
std::vector<ReportMetric> rows_of(const std::vector<NamedValues>& columns) {
  std::vector<ReportMetric> rows;
  for (std::size_t c = columns.size(); c-- > 0;)
    for (const auto& [name, value] : columns[c]) {
      const std::string title = with_unit(name);
      auto row = std::find_if(rows.begin(), rows.end(), [&title](const auto& r) { return r.name == title; });
      if (row == rows.end())
        row = rows.insert(rows.end(), {title, std::vector<double>(columns.size(), kNone)});
      row->values[c] = value;
    }
  return rows;
}

std::vector<std::string> notes_of(const record::SequenceEntry& entry) {
  std::vector<std::string> notes = entry.notes;
  if (!entry.arrangement.empty()) notes.push_back(arrangement_note(entry.arrangement));
  for (const auto& value : entry.plan) notes.push_back(note_of("plan", value));
  for (const auto& value : entry.fit) notes.push_back(note_of("keypoint fit", value));
  for (const auto& value : entry.audit)
    if (value.first.starts_with("root_")) notes.push_back(note_of("audit", value));
  for (const auto& value : entry.preparation) notes.push_back(note_of("preparation", value));
  return notes;
}

std::vector<double> column_of(const record::Table& table, const std::string& name) {
  std::vector<double> values;
  const std::size_t at = table.column(name);
  for (const auto& row : table.rows) values.push_back(row[at]);
  return values;
}

/// Of the joints of every frame, mm.
std::vector<double> distances(const std::vector<BodyPoses>& a, const std::vector<BodyPoses>& b) {
  std::vector<double> means(std::min(a.size(), b.size()));
  for (std::size_t t = 0; t < means.size(); ++t)
    for (std::size_t i = 0; i < kBodies; ++i)
      means[t] += kMm * (a[t].p_WB[i] - b[t].p_WB[i]).norm() / kBodies;
  return means;
}

/// A bar is full where half the weight, or half the weight on an arm of a metre, would have to come from
/// outside.
constexpr double kFullBar = 0.5;

ReportNeeds report_needs(const PerFrame<Vector6d>& wrenches, double mass) {
  ReportNeeds needs;
  for (const Vector6d& w : wrenches) {
    needs.force.push_back(w.tail<3>().norm());
    needs.acceleration.push_back(needs.force.back() / mass);
    needs.moment.push_back(w.head<3>().norm());
    const double most = std::max(needs.force.back(), needs.moment.back());
    needs.bar.push_back(std::min(1.0, most / (kFullBar * kGravity * mass)));
  }
  return needs;
}

/// Runs of older versions have no such file.
void add_feasibility(const std::filesystem::path& file, ReportSequence& s) {
  if (!std::filesystem::exists(file)) return;
  const record::FrameFeasibility all = record::read_feasibility(file);
  s.needs = report_needs(all.need, all.mass);
  s.wrong = all.wrong;
  s.help = report_needs(all.help, all.mass);
}

/// Whether policies were trained for the motion, be it that a plan was written in the end.
bool was_trained(const record::SequenceEntry& entry) { return entry.method != "plan" || entry.samples > 0; }

void add_training(const record::RunFolder& folder, const record::SequenceEntry& entry, ReportSequence& s) {
  const record::Table falls = record::read_csv(folder.falls(entry.name));
  const std::vector<double> frames = column_of(falls, "frame");
  const double bin = frames.size() > 1 ? frames[1] - frames[0] : 1.0;
  s.series.push_back(
      {"share of falls over the clip, in training", bin / entry.fps, column_of(falls, "fall_rate")});
  s.log = record::read_csv(folder.log(entry.name));
}

ReportSequence sequence_of(const record::RunFolder& folder, const record::SequenceEntry& entry) {
  ReportSequence s;
  s.name = entry.name;
  s.status = entry.ok ? "ok" : "failed";
  s.reason = entry.reason;
  s.notes = notes_of(entry);
  s.character = make_character();
  if (entry.output.empty()) return s;
  const motion::Clip simulated = motion::read_clip(folder.root / entry.output);
  s.fps = entry.fps;
  s.character = motion::character_of(simulated);
  s.simulated = motion::poses_of(simulated);
  s.reference = motion::poses_of(motion::read_clip(folder.reference(entry.name)));
  if (entry.metrics_before.empty()) {
    s.metric_columns = {"input", "simulated"};
    s.metrics = rows_of({entry.input_metrics, entry.metrics});
  } else {
    s.metric_columns = {"input", "before training", "simulated"};
    s.metrics = rows_of({entry.input_metrics, entry.metrics_before, entry.metrics});
  }
  const Npz motion = read_npz(folder.root / entry.output);
  s.series.push_back({"reward over the clip", 1.0 / entry.fps, motion.at("reward").to_double()});
  s.series.push_back(
      {"mean distance from the reference, mm", 1.0 / entry.fps, distances(s.simulated, s.reference)});
  add_feasibility(folder.feasibility(entry.name), s);
  if (was_trained(entry)) add_training(folder, entry, s);
  return s;
}

/// The sequence with its motions; where its files cannot be read, without them and with the reason.
ReportSequence sequence_or_reason(const record::RunFolder& folder, const record::SequenceEntry& entry) {
  try {
    return sequence_of(folder, entry);
  } catch (const std::exception& error) {
    record::SequenceEntry unseen = entry;
    unseen.output.clear();
    unseen.notes.push_back(std::string("cannot be shown: ") + error.what());
    return sequence_of(folder, unseen);
  }
}

/// Which of the entries are shown with their motions: those that are no success first.
std::vector<bool> shown(const std::vector<record::SequenceEntry>& entries) {
  std::vector<bool> show(entries.size());
  std::size_t count = 0;
  for (const bool ok : {false, true})
    for (std::size_t i = 0; i < entries.size() && count < kMostShown; ++i)
      if (entries[i].ok == ok && !entries[i].output.empty()) show[i] = true, ++count;
  return show;
}

/// What the manifest says of a motion that a page of so many leaves out.
record::SequenceEntry without_motion(record::SequenceEntry entry) {
  if (entry.output.empty()) return entry;
  entry.notes.insert(entry.notes.begin(), "not shown: this page has the motions of " +
                                              std::to_string(kMostShown) +
                                              " files, those that are no success first");
  entry.output.clear();
  return entry;
}

}  // namespace

void write_report(const record::RunFolder& folder, const record::Manifest& manifest) {
  const std::vector<bool> show = shown(manifest.sequences);
  const std::string page = format_report(manifest.sequences.size(), [&](std::size_t i) {
    const record::SequenceEntry& entry = manifest.sequences[i];
    return sequence_or_reason(folder, show[i] ? entry : without_motion(entry));
  });
  write_file_atomically(folder.report(), page);
}

}  // namespace mimicx::pipeline::report
