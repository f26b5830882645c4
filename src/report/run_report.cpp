#include "report/run_report.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/file.h"
#include "core/number_text.h"
#include "record/timing.h"
#include "report/clip_report.h"
#include "report/clip_script_file.h"
#include "report/report_bodies.h"

namespace mimicx::report {
namespace {

/// "1 h 23 min", "2 min 5 s", "24 s"
std::string in_words(double seconds) {
  const long whole = std::lround(seconds);
  if (whole >= 3600) return formatted("%ld h %ld min", whole / 3600, whole % 3600 / 60);
  if (whole >= 60) return formatted("%ld min %ld s", whole / 60, whole % 60);
  return formatted(seconds < 10.0 ? "%.1f s" : "%.0f s", seconds);
}

std::vector<std::pair<std::string, std::string>> run_in_words(const record::RunFolder& folder,
                                                              const record::Manifest& manifest, bool times) {
  double motion = 0.0, planning = 0.0, training = 0.0, all = 0.0;
  std::size_t good = 0;
  for (const record::SequenceEntry& entry : manifest.sequences) {
    if (entry.fps > 0.0) motion += entry.frames / entry.fps;
    good += entry.ok;
  }
  std::vector<std::pair<std::string, std::string>> run = {
      {"clips", std::to_string(manifest.sequences.size())},
      {"cleaned", std::to_string(good)},
      {"failed", std::to_string(manifest.sequences.size() - good)},
      {"motion in all", in_words(motion)}};
  if (times) {
    for (const record::Timing& t : record::read_timing(folder.timing())) {
      all += t.seconds, planning += t.planning_seconds, training += t.training_seconds;
    }
    run.emplace_back("work on all clips", in_words(all));
    run.emplace_back("planning", in_words(planning));
    run.emplace_back("training", in_words(training));
  }
  run.emplace_back("method", manifest.method);
  run.emplace_back("seed", std::to_string(manifest.seed));
  run.emplace_back("mimicx", manifest.version + ", " + manifest.target);
  return run;
}

}  // namespace

void write_report(const record::RunFolder& folder, const record::Manifest& manifest,
                  const ReportOptions& options) {
  const auto has_motion = [](const record::SequenceEntry& entry) { return !entry.output.empty(); };
  const auto& entries = manifest.sequences;
  const bool beside = std::count_if(entries.begin(), entries.end(), has_motion) > kMostEmbedded;
  Report report;
  report.run = run_in_words(folder, manifest, options.times);
  report.metrics = report_metrics(!options.truth.empty());
  std::vector<std::string> clips;
  ReportBodies bodies;
  if (options.map) report.map = options.map(folder, manifest, report.run);
  for (const record::SequenceEntry& entry : entries) {
    const auto truth = options.truth.find(entry.name);
    const TruthReader known = truth == options.truth.end() ? nullptr : truth->second;
    if (beside && has_motion(entry)) {
      const auto kept = options.keep ? kept_clip_script(folder, entry, report.metrics) : std::nullopt;
      report.rows.push_back(kept ? *kept : write_clip_script(folder, entry, report.metrics, known));
      clips.emplace_back();
      continue;
    }
    ReportedClip made = report_clip(folder, entry, report.metrics, known);
    for (ReportMotion& motion : made.clip.motions) motion.body = bodies.take(motion.character);
    clips.push_back(clip_json(made.clip));
    report.rows.push_back(std::move(made.row));
  }
  if (std::any_of(entries.begin(), entries.end(), has_motion)) report.skin = skin_json();
  report.bodies = bodies.texts();
  write_file_atomically(folder.report(), format_report(report, clips));
}

}  // namespace mimicx::report
