#include "pipeline/run_report.h"

#include <cstdio>
#include <limits>
#include <utility>

#include "core/npz.h"
#include "motion/clip.h"
#include "motion/metrics.h"
#include "pipeline/report.h"
#include "pipeline/table.h"

namespace mimicx {
namespace {

std::string with_unit(const std::string& metric) {
  for (const auto& d : metric_definitions())
    if (metric == d.name) return metric + ", " + d.unit;
  return metric;
}

std::string note_of(const std::pair<std::string, double>& value) {
  char text[32];
  std::snprintf(text, sizeof text, " %.2f", value.second);
  return "preparation: " + value.first + text;
}

/// Rows of both lists, in the order of the second, then what only the first has.
std::vector<ReportMetric> rows_of(const NamedValues& input, const NamedValues& simulated) {
  std::vector<ReportMetric> rows;
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [name, value] : simulated) rows.push_back({with_unit(name), {none, value}});
  for (const auto& [name, value] : input) {
    bool found = false;
    for (auto& row : rows) {
      if (row.name != with_unit(name)) continue;
      row.values[0] = value;
      found = true;
    }
    if (!found) rows.push_back({with_unit(name), {value, none}});
  }
  return rows;
}

std::vector<std::string> notes_of(const SequenceEntry& entry) {
  std::vector<std::string> notes = entry.notes;
  for (const auto& value : entry.preparation) notes.push_back(note_of(value));
  return notes;
}

std::vector<double> column_of(const Table& table, const std::string& name) {
  std::vector<double> values;
  const std::size_t at = table.column(name);
  for (const auto& row : table.rows) values.push_back(row[at]);
  return values;
}

ReportSequence sequence_of(const RunFolder& folder, const SequenceEntry& entry) {
  ReportSequence s;
  s.name = entry.name;
  s.status = entry.ok ? "ok" : "failed";
  s.reason = entry.reason;
  s.notes = notes_of(entry);
  s.character = make_character();
  if (entry.output.empty()) return s;
  const Clip simulated = read_clip(folder.root / entry.output);
  s.fps = entry.fps;
  s.character = make_character(simulated.usable_betas());
  s.simulated = poses_of(simulated);
  s.reference = poses_of(read_clip(folder.reference(entry.name)));
  s.metric_columns = {"input", "simulated"};
  s.metrics = rows_of(entry.input_metrics, entry.metrics);
  const Npz motion = read_npz(folder.root / entry.output);
  s.series.push_back({"reward over the clip", 1.0 / entry.fps, motion.at("reward").to_double()});
  const Table falls = read_csv(folder.falls(entry.name));
  const std::vector<double> frames = column_of(falls, "frame");
  const double bin = frames.size() > 1 ? frames[1] - frames[0] : 1.0;
  s.series.push_back(
      {"share of falls over the clip, in training", bin / entry.fps, column_of(falls, "fall_rate")});
  s.log = read_csv(folder.log(entry.name));
  return s;
}

}  // namespace

void write_report(const RunFolder& folder, const Manifest& manifest) {
  std::vector<ReportSequence> sequences;
  for (const auto& entry : manifest.sequences) sequences.push_back(sequence_of(folder, entry));
  write_file_atomically(folder.report(), format_report(sequences));
}

}  // namespace mimicx
