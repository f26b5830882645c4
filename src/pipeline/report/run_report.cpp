#include "pipeline/report/run_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "core/file.h"
#include "motion/clip_file.h"
#include "motion/prepare.h"
#include "pipeline/record/timing.h"
#include "pipeline/report/bodies.h"
#include "pipeline/report/clip_beside.h"
#include "pipeline/report/clip_report.h"
#include "pipeline/report/cluster_map.h"

namespace mimicx::pipeline::report {
namespace {

/// "1 h 23 min", "2 min 5 s", "24 s"
std::string in_words(double seconds) {
  char text[48];
  const long whole = std::lround(seconds);
  if (whole >= 3600)
    std::snprintf(text, sizeof text, "%ld h %ld min", whole / 3600, whole % 3600 / 60);
  else if (whole >= 60)
    std::snprintf(text, sizeof text, "%ld min %ld s", whole / 60, whole % 60);
  else
    std::snprintf(text, sizeof text, seconds < 10.0 ? "%.1f s" : "%.0f s", seconds);
  return text;
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
    run.emplace_back("work on the clips, summed up", in_words(all));
    run.emplace_back("of it planning", in_words(planning));
    run.emplace_back("of it training", in_words(training));
  }
  run.emplace_back("method", manifest.method);
  run.emplace_back("seed", std::to_string(manifest.seed));
  run.emplace_back("mimicx", manifest.version + ", " + manifest.target);
  return run;
}

/// The clusters of the options, and where the motions of the run are among them.
struct MotionMap {
  options::Clusters clusters;
  ClusterMap map;

  /// By the prepared reference, as options are chosen by it. One that is gone or too short is left out.
  void add(const record::RunFolder& folder, const record::SequenceEntry& entry, int row) {
    const std::filesystem::path file = folder.reference(entry.name);
    if (entry.output.empty() || !std::filesystem::exists(file)) return;
    try {
      const motion::PreparationConfig as_it_is{
          .separate = false, .level_feet = false, .ground = false, .bridge_flagged = false};
      const motion::MotionFeatures features =
          motion::motion_features(motion::prepare_reference(motion::read_clip(file), as_it_is, nullptr));
      map.clips.push_back({map.place(features), options::nearest_cluster(clusters, features), "", row});
    } catch (const DataError&) {
      return;
    }
  }
};

/// Empty where no options are known, or features of their motions; what cannot be read is said among the
/// facts of the run.
std::optional<MotionMap> map_for(const record::RunFolder& folder, const ReportOptions& options,
                                 std::vector<std::pair<std::string, std::string>>& run) {
  std::vector<std::filesystem::path> files = options.clusters;
  if (files.empty() && std::filesystem::exists(folder.clusters())) files = {folder.clusters()};
  if (files.empty()) return std::nullopt;
  try {
    MotionMap map{options::read_clusters(files), {}};
    map.map = map_of(map.clusters);
    return map;
  } catch (const std::invalid_argument&) {
    run.emplace_back("no map of the motions", "the options' clusters.json does not have their features");
  } catch (const DataError&) {
    run.emplace_back("no map of the motions", "the options' clusters.json cannot be read");
  }
  return std::nullopt;
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
  std::optional<MotionMap> map = map_for(folder, options, report.run);
  for (const record::SequenceEntry& entry : entries) {
    const auto truth = options.truth.find(entry.name);
    const std::filesystem::path known = truth == options.truth.end() ? "" : truth->second;
    if (map) map->add(folder, entry, static_cast<int>(report.rows.size()));
    if (beside && has_motion(entry)) {
      const auto kept = options.keep ? kept_clip_beside(folder, entry, report.metrics) : std::nullopt;
      report.rows.push_back(kept ? *kept : write_clip_beside(folder, entry, report.metrics, known));
      clips.emplace_back();
      continue;
    }
    ReportedClip made = report_clip(folder, entry, report.metrics, known);
    for (ReportMotion& motion : made.clip.motions) motion.body = bodies.take(motion.character);
    clips.push_back(clip_json(made.clip));
    report.rows.push_back(std::move(made.row));
  }
  if (map) report.map = map_json(map->map);
  if (std::any_of(entries.begin(), entries.end(), has_motion)) report.skin = skin_json();
  report.bodies = bodies.texts();
  write_file_atomically(folder.report(), format_report(report, clips));
}

}  // namespace mimicx::pipeline::report
