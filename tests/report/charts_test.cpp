#include "report/charts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/standing_clip.h"

namespace mimicx::report {
namespace {

MeasuredMotion standing_reference(int frames) {
  const motion::Clip clip = motion::standing_clip(frames);
  return measured(motion::sample_motion(motion::character_of(clip), motion::poses_of(clip), clip.fps),
                  std::vector<double>(static_cast<std::size_t>(frames), 0.0));
}

const ReportBars& row(const std::vector<ReportBars>& bars, const std::string& name) {
  for (const ReportBars& b : bars)
    if (b.name == name) return b;
  throw std::out_of_range(name);
}

/// The values from frame 1 on; frame 0, which ends no interval, has to have none.
std::vector<double> behind_gap(const std::vector<double>& values) {
  EXPECT_TRUE(std::isnan(values.at(0)));
  return {values.begin() + 1, values.end()};
}

TEST(Charts, OmitsMissingData) {
  const MeasuredMotion motion = standing_reference(6);
  ChartSources sources;
  sources.motions = {{Who::kCleaned, &motion}};
  for (const ReportChart& chart : charts_of(sources)) {
    ASSERT_EQ(chart.lines.size(), 1u) << chart.words.words;
    EXPECT_EQ(chart.lines[0].values.size(), 6u);
    EXPECT_EQ(chart.step, 1.0 / 30.0);
  }
  EXPECT_EQ(charts_of(sources).size(), 4u);
}

TEST(Charts, ForcesAreInBodyWeightsFromFrameOneOn) {
  const MeasuredMotion motion = standing_reference(3);
  std::vector<files::FloorArrows> ground(3);
  for (std::size_t t = 1; t < 3; ++t) {
    ground[t][0].force.z() = 350.0;
    ground[t][1].force.z() = 1050.0;
  }
  ChartSources sources;
  sources.motions = {{Who::kCleaned, &motion}};
  sources.ground = &ground;
  sources.weight = 700.0;
  const std::vector<ReportChart> charts = charts_of(sources);
  const ReportChart* forces = nullptr;
  for (const ReportChart& chart : charts)
    if (chart.words.unit == "body weights") forces = &chart;
  ASSERT_TRUE(forces);
  ASSERT_EQ(forces->lines.size(), 2u) << "nothing but the feet touches the floor";
  EXPECT_EQ(behind_gap(forces->lines[0].values), std::vector<double>(2, 0.5));
  EXPECT_EQ(behind_gap(forces->lines[1].values), std::vector<double>(2, 1.5));
}

TEST(Charts, ForcesOfTheFeetHaveTheRangeThatExplainsTheMotion) {
  const MeasuredMotion motion = standing_reference(3);
  std::vector<files::FloorArrows> ground(3);
  std::vector<audit::LoadSharing> sharing(3, audit::LoadSharing::none());
  for (std::size_t t = 1; t < 3; ++t) {
    ground[t][0].force.z() = ground[t][2].force.z() = 350.0;
    sharing[t].least[1].z() = 70.0;
    sharing[t].most[1].z() = 140.0;
  }
  ChartSources sources;
  sources.motions = {{Who::kCleaned, &motion}};
  sources.ground = &ground;
  sources.sharing = &sharing;
  sources.weight = 700.0;
  for (const ReportChart& chart : charts_of(sources)) {
    if (chart.words.unit != "body weights") continue;
    ASSERT_EQ(chart.lines.size(), 3u);
    EXPECT_EQ(behind_gap(chart.lines[0].least), std::vector<double>(2, 0.0));
    EXPECT_EQ(behind_gap(chart.lines[1].least), std::vector<double>(2, 0.1));
    EXPECT_EQ(behind_gap(chart.lines[1].most), std::vector<double>(2, 0.2));
    EXPECT_TRUE(chart.lines[2].least.empty()) << "the rest of the body shares nothing";
    return;
  }
  FAIL() << "no chart of forces";
}

TEST(Charts, NeedsOfTheInputAreTheirForces) {
  const MeasuredMotion motion = standing_reference(5);
  audit::PoseNeeds needs;
  needs.frames.resize(2);
  needs.frames[1].force = {3.0, 0.0, 4.0};
  ChartSources sources;
  sources.motions = {{Who::kInput, &motion}};
  sources.needs_of_input = &needs;
  int found = 0;
  for (const ReportChart& chart : charts_of(sources)) {
    if (chart.words.words != "unexplained force") continue;
    EXPECT_EQ(chart.lines.at(0).values, (std::vector<double>{0.0, 5.0}));
    ++found;
  }
  EXPECT_EQ(found, 1);
}

TEST(Charts, AuditValuesAreAtTheirFrames) {
  const MeasuredMotion motion = standing_reference(5);
  audit::Audit audit;
  for (const int frame : {1, 3}) {
    audit.rows.emplace_back();
    audit.rows.back().index = frame;
    audit.rows.back().root << 9.0, 9.0, 9.0, 3.0, 0.0, 4.0;
    audit.rows.back().torque_share = 0.25;
  }
  ChartSources sources;
  sources.motions = {{Who::kCleaned, &motion}};
  sources.audit_of_cleaned = &audit;
  int found = 0;
  for (const ReportChart& chart : charts_of(sources)) {
    const double expected = chart.words.words == "unexplained force"      ? 5.0
                            : chart.words.words == "largest joint torque" ? 25.0
                                                                          : NAN;
    if (std::isnan(expected)) continue;
    ++found;
    const std::vector<double>& values = chart.lines.at(0).values;
    ASSERT_EQ(values.size(), 4u);
    EXPECT_TRUE(std::isnan(values[0]) && std::isnan(values[2]));
    EXPECT_EQ(values[1], expected);
    EXPECT_EQ(values[3], expected);
  }
  EXPECT_EQ(found, 2);
}

TEST(Charts, ColumnsOfOneTitleShareAChart) {
  record::Table log{{"iteration", "samples", "reward", "reward_term:pose", "reward_term:velocity", "sigma"},
                    {{0, 512, 0.5, 0.6, 0.7, 0.1}, {1, 1024, 0.6, 0.7, 0.8, 0.1}}};
  const std::vector<ReportChart> charts = training_charts(log);
  ASSERT_EQ(charts.size(), 3u);
  EXPECT_EQ(charts[0].x, (std::vector<double>{512, 1024}));
  ASSERT_EQ(charts[1].lines.size(), 2u);
  EXPECT_EQ(charts[1].lines[1].name, "joint velocities");
  EXPECT_EQ(charts[1].lines[1].values, (std::vector<double>{0.7, 0.8}));
}

TEST(Bars, FeetAreInContactWhereTheFloorPushes) {
  const MeasuredMotion motion = standing_reference(6);
  std::vector<files::FloorArrows> ground(6);
  for (std::size_t t = 1; t < 6; ++t) ground[t][0].force.z() = t < 4 ? 600.0 : 5.0;
  const std::vector<ReportBars> bars = bars_of(nullptr, motion, ground, 700.0);
  ASSERT_EQ(bars.size(), 2u) << "without an input there are no flaws";
  const std::vector<Span>& left = row(bars, "left foot").spans;
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].first, 0) << "the frame before the first interval is like it";
  EXPECT_EQ(left[0].last, 3);
  EXPECT_TRUE(row(bars, "right foot").spans.empty());
}

TEST(Bars, ContactFollowsFootHeightWithoutForces) {
  MeasuredMotion motion = standing_reference(4);
  for (auto& points : motion.samples.surface)
    for (std::size_t i = 0; i < points.size(); ++i) points[i].z() = i < kPointsPerFoot ? 0.004 : 0.3;
  const std::vector<ReportBars> bars = bars_of(&motion, motion, {}, 0.0);
  ASSERT_EQ(bars.size(), 6u);
  EXPECT_EQ(row(bars, "left foot").spans.size(), 1u);
  EXPECT_TRUE(row(bars, "right foot").spans.empty());
  EXPECT_TRUE(row(bars, "input floats").flaw);
  EXPECT_EQ(row(bars, "input floats").who, Who::kInput);
  EXPECT_FALSE(row(bars, "left foot").flaw);
  EXPECT_EQ(row(bars, "left foot").who, Who::kCleaned);
}

}  // namespace
}  // namespace mimicx::report
