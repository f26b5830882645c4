#include "report/charts.h"

#include <algorithm>
#include <cmath>

#include "report/base64_digits.h"
#include "rl/tracking/reward.h"

namespace mimicx::report {
namespace {

constexpr double kLeastLoad = 0.02;  ///< of the weight; a foot with at least this load is in contact

/// A line per motion.
ReportChart over_motions(const ChartSources& sources, const Words& words,
                         std::vector<double> MotionCurves::*values, bool reference) {
  ReportChart chart{words, {}};
  for (const auto& [who, motion] : sources.motions)
    if (reference || who != Who::kReference)
      chart.lines.push_back({who, title_of(who), motion->curves.*values});
  return chart;
}

/// A value per row of an audit, at the rows' frames.
template <class Value>
std::vector<double> per_frame(const audit::Audit& audit, const Value& value) {
  std::vector<double> values;
  for (const audit::AuditRow& row : audit.rows) {
    values.resize(std::max(values.size(), static_cast<std::size_t>(row.index) + 1), kNoValue);
    values[static_cast<std::size_t>(row.index)] = value(row);
  }
  return values;
}

ReportChart unexplained_chart(const ChartSources& sources) {
  ReportChart chart{
      {"unexplained force", "N",
       "external force that the motion would need: of the input by its poses, beside the best floor forces; "
       "of the cleaned motion, beyond its recorded forces"},
      {}};
  const auto force = [](const audit::AuditRow& row) { return row.root.tail<3>().norm(); };
  if (sources.needs_of_input) {
    chart.lines.push_back({Who::kInput, title_of(Who::kInput), {}});
    for (const audit::PoseNeed& need : sources.needs_of_input->frames)
      chart.lines.back().values.push_back(need.force.norm());
  }
  if (sources.audit_of_cleaned)
    chart.lines.push_back(
        {Who::kCleaned, title_of(Who::kCleaned), per_frame(*sources.audit_of_cleaned, force)});
  return chart;
}

ReportChart reward_chart(const ChartSources& sources) {
  ReportChart chart{{"reward and its factors", "", "1: as the reference; the reward is the factors' product"},
                    {}};
  if (!sources.members || !sources.members->has("reward")) return chart;
  chart.lines.push_back({Who::kCleaned, "reward", sources.members->at("reward").to_double()});
  if (!sources.members->has("reward_factors")) return chart;
  const std::vector<double> all = sources.members->at("reward_factors").to_double();
  constexpr auto kTerms = static_cast<std::size_t>(rl::tracking::kRewardTerms);
  for (std::size_t k = 0; k < kTerms; ++k) {
    ReportLine line{Who::kNobody, words_of_line(std::string(rl::tracking::kRewardTermNames[k])), {}};
    for (std::size_t at = k; at < all.size(); at += kTerms) line.values.push_back(all[at]);
    chart.lines.push_back(line);
  }
  return chart;
}

ReportChart torque_chart(const ChartSources& sources) {
  ReportChart chart{{"largest joint torque", "% of its bound", "over all joints, the controller's part"}, {}};
  if (sources.audit_of_cleaned)
    chart.lines.push_back(
        {Who::kCleaned, title_of(Who::kCleaned),
         per_frame(*sources.audit_of_cleaned, [](const auto& row) { return 100.0 * row.torque_share; })});
  return chart;
}

/// A mean over the interval that ends at the frame; frame 0 ends none.
double or_gap(std::size_t frame, double force) { return frame == 0 ? kNoValue : force; }

ReportChart ground_chart(const ChartSources& sources) {
  const bool ranges = sources.sharing && !sources.sharing->empty();
  ReportChart chart{
      {"force of the floor", "body weights",
       ranges ? "upwards, mean over the frame before; shaded: all that would explain the motion, "
                "which does not say how two feet share a load"
              : "upwards, mean over the frame before"},
      {}};
  if (!sources.ground || sources.ground->empty()) return chart;
  constexpr Array<const char*, files::kCarriers> kNames = {"left foot", "right foot", "rest of the body"};
  for (int k = 0; k < files::kCarriers; ++k) {
    ReportLine line{Who::kNobody, kNames[k], {}};
    for (std::size_t t = 0; t < sources.ground->size(); ++t)
      line.values.push_back(or_gap(t, (*sources.ground)[t][k].force.z() / sources.weight));
    for (std::size_t t = 0; k < 2 && ranges && t < sources.sharing->size(); ++t) {
      line.least.push_back(or_gap(t, (*sources.sharing)[t].least[k].z() / sources.weight));
      line.most.push_back(or_gap(t, (*sources.sharing)[t].most[k].z() / sources.weight));
    }
    const bool any =
        std::any_of(line.values.begin(), line.values.end(), [](double f) { return std::abs(f) > 0.0; });
    if (k < 2 || any) chart.lines.push_back(line);
  }
  return chart;
}

ReportChart distance_chart(const ChartSources& sources) {
  ReportChart chart{{"distance from the prepared reference", "mm", "mean over the joints"}, {}};
  const motion::MotionSamples *reference = nullptr, *cleaned = nullptr;
  for (const auto& [who, motion] : sources.motions) {
    if (who == Who::kReference) reference = &motion->samples;
    if (who == Who::kCleaned) cleaned = &motion->samples;
  }
  if (reference && cleaned)
    chart.lines.push_back({Who::kCleaned, title_of(Who::kCleaned), joint_distances(*cleaned, *reference)});
  return chart;
}

/// Whether a foot's points touch the floor. @param foot  0 left, 1 right
bool touches(const std::vector<Vector3d>& surface, const Scene& scene, std::size_t foot) {
  for (std::size_t i = 0; i < kPointsPerFoot; ++i)
    if (scene.clearance(surface[foot * kPointsPerFoot + i]) <= motion::kContactHeight) return true;
  return false;
}

}  // namespace

std::string title_of(Who who) {
  constexpr Array<const char*, 5> kTitles = {"input", "prepared reference", "cleaned", "truth", ""};
  return kTitles[static_cast<int>(who)];
}

std::vector<ReportChart> charts_of(const ChartSources& sources) {
  std::vector<ReportChart> charts = {
      over_motions(sources, {"height of the pelvis", "m", ""}, &MotionCurves::pelvis_height, true),
      over_motions(sources, {"lowest point over the floor", "mm", "under 0: in the floor"},
                   &MotionCurves::lowest, false),
      over_motions(sources,
                   {"sliding", "mm/frame",
                    "slip of the feet that carry the body, by their load; no line where none does"},
                   &MotionCurves::slip, false),
      over_motions(sources, {"acceleration of the joints", "m/s²", "mean over the joints"},
                   &MotionCurves::acceleration, false),
      unexplained_chart(sources),
      ground_chart(sources),
      torque_chart(sources),
      reward_chart(sources),
      distance_chart(sources)};
  std::erase_if(charts, [](const ReportChart& chart) { return chart.lines.empty(); });
  double fps = 30.0;
  for (const auto& [who, motion] : sources.motions) fps = motion->samples.fps;
  for (ReportChart& chart : charts) chart.step = 1.0 / fps;
  return charts;
}

std::vector<ReportChart> training_charts(const record::Table& log) {
  const std::vector<std::string>& columns = log.columns;
  const auto column = [&log](std::size_t k) {
    std::vector<double> values;
    for (const auto& row : log.rows) values.push_back(row[k]);
    return values;
  };
  const std::vector<double> samples = column(log.column("samples"));
  std::vector<ReportChart> charts;
  std::string last;  // columns of one chart are adjacent
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k] == "iteration" || columns[k] == "samples") continue;
    const std::size_t colon = columns[k].find(':');
    const std::string title = columns[k].substr(0, colon);
    if (title != last) {
      charts.push_back({words_of_log(title), {}});
      charts.back().x = samples;
    }
    last = title;
    const std::string part = colon == std::string::npos ? "" : words_of_line(columns[k].substr(colon + 1));
    charts.back().lines.push_back({Who::kNobody, part, column(k)});
  }
  return charts;
}

ReportChart falls_chart(const record::Table& falls, double fps) {
  ReportChart chart{{"falls in training", "share", "of the visits of the frame that ended in a fall"}, {}};
  const std::size_t frame = falls.column("frame"), rate = falls.column("fall_rate");
  ReportLine line{Who::kNobody, "", {}};
  for (const auto& row : falls.rows) line.values.push_back(row[rate]);
  chart.lines.push_back(line);
  chart.step = (falls.rows.size() > 1 ? falls.rows[1][frame] - falls.rows[0][frame] : 1.0) / fps;
  return chart;
}

std::vector<ReportBars> bars_of(const MeasuredMotion* input, const MeasuredMotion& cleaned,
                                const std::vector<files::FloorArrows>& ground, double weight) {
  std::vector<ReportBars> bars;
  if (input) {
    const Flaws flaws = flaws_of(*input, cleaned);
    bars.push_back({"input sinks", "the input's lowest point is deeper than 5 mm", true,
                    spans_of(flaws.sinks), Who::kInput});
    bars.push_back({"input floats",
                    "the input's lowest point is higher than 5 mm where the cleaned motion stands", true,
                    spans_of(flaws.floats), Who::kInput});
    bars.push_back({"input slides", "feet of the input that carry the body slip by more than 3 mm in a frame",
                    true, spans_of(flaws.slides), Who::kInput});
    bars.push_back({"input shakes",
                    "the input's joints accelerate 2 m/s² or more beyond those of the cleaned motion", true,
                    spans_of(flaws.shakes), Who::kInput});
  }
  for (const std::size_t foot : {std::size_t{0}, std::size_t{1}}) {
    std::vector<bool> stands;
    for (int t = 0; t < cleaned.samples.frames(); ++t)
      stands.push_back(ground.empty()
                           ? touches(cleaned.samples.surface[t], cleaned.samples.scene, foot)
                           : ground[static_cast<std::size_t>(t)][foot].force.z() > kLeastLoad * weight);
    // Frame 0 ends no interval, so it has no forces.
    if (stands.size() > 1 && !ground.empty()) stands[0] = stands[1];
    bars.push_back({foot == 0 ? "left foot" : "right foot",
                    ground.empty()
                        ? "of the cleaned motion, within 5 mm of the floor"
                        : "of the cleaned motion, pushed by the floor with 2 % of the weight or more",
                    false, spans_of(stands)});
  }
  return bars;
}

}  // namespace mimicx::report
