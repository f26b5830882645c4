#include "report/run_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/file.h"
#include "core/temporary_folder.h"
#include "core/units.h"
#include "files/archive_members.h"
#include "judge/evaluate.h"
#include "motion/clip_file.h"
#include "motion/standing_clip.h"
#include "motion/uneven_joints.h"
#include "pipeline/cluster_map.h"
#include "pipeline/options/features.h"
#include "record/json.h"

namespace mimicx::report {
namespace {

constexpr int kRunFrames = 6;
constexpr const char* kEmbedded = "\"application/json\" id=\"clip-";

std::size_t count(const std::string& text, const std::string& words) {
  std::size_t found = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++found;
  return found;
}

motion::Clip raised(double height) {
  motion::Clip clip = motion::standing_clip(kRunFrames);
  for (Vector3d& place : clip.trans) place.z() += height;
  return clip;
}

/// A folder of motions as a run leaves them, with input and reference, without forces.
struct Folder {
  explicit Folder(int clips) {
    make_folder(run.root);
    for (int k = 0; k < clips; ++k) add("clip " + std::to_string(k), k % 7 != 3);
  }
  void add(const std::string& name, bool ok) {
    record::SequenceEntry entry;
    entry.name = entry.input = name;
    entry.ok = ok;
    entry.reason = ok ? "" : "it fell";
    entry.output = record::RunFolder::motion_name(name, ok);
    entry.frames = kRunFrames;
    entry.fps = 30.0;
    entry.method = "plan";
    entry.input_metrics = {{"Float", 40.0}, {"FS", 0.0}};
    entry.metrics = {{"Float", 1.0}, {"FS", 0.125}, {"max_distance_mm", 12.0}};
    entry.audit = {{"root_force_mean_N", 0.5}};
    write(run.root / entry.output, raised(0.001));
    write(run.input(name), raised(0.05));
    write(run.reference(name), raised(0.0));
    manifest.put(entry);
  }
  static void write(const std::filesystem::path& file, const motion::Clip& clip) {
    make_folder(file.parent_path());
    motion::write_clip(file, clip);
  }
  std::string page(const ReportOptions& options = {.map = pipeline::draw_kept_map}) {
    write_report(run, manifest, options);
    return read_file(run.report());
  }
  TemporaryFolder folder;
  record::RunFolder run{folder.path / "run"};
  record::Manifest manifest;
};

TruthReader reader_of(const std::filesystem::path& file) {
  return [file] { return motion::read_clip(file); };
}

record::Json json_element(const std::string& page, const std::string& id) {
  const std::size_t name = page.find("id=\"" + id + "\""), begin = page.find('>', name) + 1;
  return record::Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

using Numbers = std::vector<std::optional<double>>;

/// Of an array; nothing for null.
Numbers numbers(const record::Json& json) {
  Numbers all;
  for (const auto& value : json.elements())
    all.push_back(value.is_null() ? std::nullopt : std::optional(value.get<double>()));
  return all;
}

/// [input, before training, cleaned] of a clip.
record::Json values(const std::string& page, const std::string& key, std::size_t clip = 0) {
  const auto data = json_element(page, "data");
  for (std::size_t k = 0; k < data.at("metrics").elements().size(); ++k)
    if (data.at("metrics").at(k).at("key").get<std::string>() == key)
      return data.at("rows").at(clip).at("values").at(k);
  return nullptr;
}

TEST(RunReport, EmbedsFiftyClipsAndWritesMoreToFiles) {
  Folder few(50);
  const std::string one = few.page();
  EXPECT_EQ(count(one, kEmbedded), 50u);
  EXPECT_FALSE(std::filesystem::exists(few.run.root / "report"));
  few.add("clip 50", true);
  const std::string page = few.page();
  EXPECT_EQ(count(page, kEmbedded), 0u);
  EXPECT_LT(page.size(), one.size() / 2);
  const std::string script = read_file(few.run.report_clip("clip 7"));
  const std::string opening = "\nmimicx_clip(";
  const std::size_t call = script.find(opening);
  ASSERT_NE(call, std::string::npos);
  EXPECT_TRUE(script.starts_with("// "));
  const std::size_t begin = call + opening.size();
  const auto told = record::Json::parse("[" + script.substr(begin, script.size() - begin - 3) + "]");
  EXPECT_EQ(told.at(0).get<std::string>(), "clip 7");
  EXPECT_EQ(told.at(1).dump(), json_element(one, "clip-7").dump());
  ASSERT_EQ(told.at(2).items().size(), 1u) << "all wear the standard body";
  const std::string key = told.at(2).items().front().first;
  EXPECT_EQ(told.at(2).at(key).dump(), json_element(one, "body-" + key).dump());
  EXPECT_EQ(told.at(1).at("motions").at(0).at("body").get<std::string>(), key);
  EXPECT_EQ(count(one, "id=\"body-"), 1u);
  EXPECT_EQ(count(page, "id=\"body-"), 0u);
  EXPECT_EQ(json_element(page, "skin").dump(), json_element(one, "skin").dump());
}

/// All files of the report, by name.
std::map<std::string, std::string> report_files(const record::RunFolder& run) {
  std::map<std::string, std::string> files = {{"page", read_file(run.report())}};
  for (const auto& file : std::filesystem::directory_iterator(run.root / "report"))
    files[file.path().filename().string()] = read_file(file.path());
  return files;
}

TEST(RunReport, KeepsClipFilesOfUnchangedResultsWithoutReadingMotions) {
  Folder run(51);
  run.page();
  const auto files = report_files(run.run);
  ASSERT_EQ(files.size(), 52u);
  std::filesystem::remove_all(run.run.root / "motions");
  ReportOptions keep;
  keep.keep = true;
  run.page(keep);
  EXPECT_EQ(report_files(run.run), files);
  EXPECT_NE(run.page(), files.at("page")) << "who asks for the report again has it made of what is there";
}

TEST(RunReport, RemakesClipFilesThatAreOutdatedHaveATruthOrAreIncomplete) {
  Folder run(51);
  ReportOptions keep;
  keep.keep = true;
  run.page();
  const auto files = report_files(run.run);
  const std::filesystem::path file = run.run.report_clip("clip 7");
  const record::SequenceEntry entry = *run.manifest.find("clip 7");
  record::SequenceEntry other = entry;
  other.notes.push_back("done anew");
  run.manifest.put(other);
  run.page(keep);
  EXPECT_NE(read_file(file).find("done anew"), std::string::npos);
  run.manifest.put(entry);
  ReportOptions truth;
  truth.truth = {{"clip 7", reader_of(run.run.reference("clip 7"))}};
  run.page(truth);
  EXPECT_NE(read_file(file).find("\"truth\""), std::string::npos);
  run.page(keep);
  EXPECT_EQ(report_files(run.run), files);
  const std::string whole = read_file(file);
  for (const std::string& damaged : {std::string(), whole.substr(0, whole.find('[') + 4),
                                     whole.substr(0, whole.size() / 2), "// of another\n" + whole}) {
    write_file_atomically(file, damaged);
    run.page(keep);
    EXPECT_EQ(read_file(file), whole) << damaged.substr(0, 60);
  }
}

TEST(RunReport, UnreadableInputsNeedNoClipFiles) {
  Folder run(0);
  for (int k = 0; k < 1000; ++k) {
    record::SequenceEntry entry;
    entry.name = entry.input = std::to_string(k);
    entry.reason = "no such file";
    run.manifest.put(entry);
  }
  const std::string page = run.page();
  EXPECT_EQ(count(page, "no such file"), 1000u);
  EXPECT_FALSE(std::filesystem::exists(run.run.root / "report"));
}

TEST(RunReport, ClipWithMissingFilesSaysSo) {
  Folder run(2);
  std::filesystem::remove(run.run.reference("clip 1"));
  const std::string page = run.page();
  EXPECT_FALSE(json_element(page, "clip-0").at("motions").elements().empty());
  const auto clip = json_element(page, "clip-1");
  EXPECT_TRUE(clip.at("motions").elements().empty());
  EXPECT_TRUE(clip.at("notes").elements().back().get<std::string>().starts_with("cannot be shown: "));
}

TEST(RunReport, OmitsTheInputOfOlderRuns) {
  Folder run(1);
  std::filesystem::remove(run.run.input("clip 0"));
  const auto clip = json_element(run.page(), "clip-0");
  ASSERT_EQ(clip.at("motions").elements().size(), 2u);
  EXPECT_EQ(clip.at("motions").at(0).at("who").get<std::string>(), "reference");
  for (const auto& bars : clip.at("bars").elements()) EXPECT_FALSE(bars.at("flaw").get<bool>());
}

TEST(RunReport, TableHasTheManifestsNumbers) {
  Folder run(1);
  const std::string page = run.page();
  EXPECT_EQ(numbers(values(page, "Float")), (Numbers{40.0, {}, 1.0}));
  EXPECT_EQ(numbers(values(page, "FS")), (Numbers{0.0, {}, 0.125}));
  EXPECT_EQ(values(page, "max_distance_mm").at(2).get<double>(), 12.0);
  EXPECT_EQ(values(page, "root_force_mean_N").at(2).get<double>(), 0.5);
  // A body that hangs 5 cm over the floor needs its weight from nowhere, by its poses.
  EXPECT_NEAR(values(page, "root_force_mean_N").at(0).get<double>(), 9.81 * make_character().total_mass(),
              30.0);
  for (const motion::MetricDefinition& d : motion::metric_definitions())
    EXPECT_FALSE(values(page, d.name).is_null()) << d.name << " has no column";
}

TEST(RunReport, MetricsThatNeedTheReferenceAreInItsGroup) {
  std::map<std::string, std::string> groups;
  for (const ReportMetric& metric : report_metrics(false)) groups[metric.key] = metric.group;
  for (const char* name : {"MPJPE", "Accel", "FS_gt", "Float_gt", "max_distance_mm"})
    EXPECT_EQ(groups.at(name), "against the prepared reference") << name;
  for (const char* name : {"root_force_mean_N", "slip", "FS", "Float", "GP", "Jitter"})
    EXPECT_EQ(groups.at(name), "without reference") << name;
}

TEST(RunReport, MetricsAgainstTheTruthAreThoseOfEvaluate) {
  Folder run(1);
  const std::filesystem::path truth = run.folder.path / "truth";
  Folder::write(truth / "clip 0.npz", raised(-0.002));
  ReportOptions options;
  options.truth = {{"clip 0", reader_of(truth / "clip 0.npz")}};
  const std::string page = run.page(options);
  EXPECT_EQ(json_element(page, "clip-0").at("motions").elements().back().at("who").get<std::string>(),
            "truth");
  for (const auto& [folder, column] : {std::pair{"inputs", 0}, std::pair{"motions", 2}}) {
    const judge::Evaluation told = judge::evaluate_folders(truth, run.run.root / folder);
    ASSERT_EQ(told.motions.size(), 1u);
    for (const char* name : {"MRPE", "gMPJPE", "MPJPE", "Accel", "FS_gt", "Float_gt"}) {
      double expected = 0.0;
      for (const motion::MetricDefinition& d : motion::metric_definitions())
        if (d.name == std::string(name)) expected = (told.motions[0].metrics.*d.value).value;
      const auto value = values(page, std::string("truth:") + name).at(static_cast<std::size_t>(column));
      EXPECT_NEAR(value.get<double>(), expected, 1e-5 * std::abs(expected) + 1e-9) << folder << ' ' << name;
    }
  }
  EXPECT_TRUE(values(run.page(), "truth:MRPE").is_null()) << "without a truth there is no such column";
}

TEST(RunReport, ShowsWhereAClipIsWorseThanItsInputAndWhatWasFollowedInPart) {
  Folder run(4);
  record::SequenceEntry worse = run.manifest.sequences[0], lost = run.manifest.sequences[3];
  worse.worse = {{"sliding", "0.4 -> 0.9 mm a frame", {{1, 2}, {5, 5}}, "its reference slides, too"}};
  lost.parts = {{0, 2}, {4, 5}};
  run.manifest.put(worse);
  run.manifest.put(lost);
  const std::string page = run.page();
  const auto row = [&](const std::string& clip, const std::string& name) {
    const auto all = json_element(page, clip);
    for (const auto& bars : all.at("bars").elements())
      if (bars.at("name").get<std::string>() == name) return bars;
    return record::Json();
  };
  const auto more = row("clip-0", "more sliding");
  EXPECT_EQ(more.at("spans").dump(), "[[1,2],[5,5]]");
  EXPECT_EQ(more.at("meaning").get<std::string>(),
            "worse than the input, 0.4 -> 0.9 mm a frame: its reference slides, too");
  EXPECT_TRUE(more.at("flaw").get<bool>());
  EXPECT_EQ(more.at("who").get<std::string>(), "cleaned");
  EXPECT_EQ(row("clip-0", "input floats").at("who").get<std::string>(), "input");
  EXPECT_EQ(row("clip-3", "followed in part").at("who").get<std::string>(), "cleaned");
  EXPECT_EQ(row("clip-3", "followed in part").at("spans").dump(), "[[0,2],[4,5]]");
  EXPECT_NE(page.find("sliding 0.4 -> 0.9 mm a frame, most at frames 1-2, 5: its reference"),
            std::string::npos);
  EXPECT_NE(page.find("frames 0-2 in motions/clip 3.part1.npz, frames 4-5 in motions/clip 3.part2.npz"),
            std::string::npos);
  EXPECT_TRUE(row("clip-1", "more sliding").is_null());
}

TEST(RunReport, TruthOfAnotherLengthIsNotCompared) {
  Folder run(1);
  const std::filesystem::path truth = run.folder.path / "truth";
  motion::Clip other = raised(0.0);
  other.rotations.resize(other.rotations.size() + 5, other.rotations.back());
  other.trans.resize(other.rotations.size(), other.trans.back());
  Folder::write(truth / "clip 0.npz", other);
  ReportOptions options;
  options.truth = {{"clip 0", reader_of(truth / "clip 0.npz")}};
  const std::string page = run.page(options);
  EXPECT_TRUE(values(page, "truth:MRPE").at(2).is_null());
  const auto clip = json_element(page, "clip-0");
  EXPECT_TRUE(clip.at("notes").elements().back().get<std::string>().starts_with(
      "not compared with the truth: it has "));
}

TEST(RunReport, ReportsAnUnreadableTruth) {
  Folder run(1);
  ReportOptions options;
  options.truth = {{"clip 0", reader_of(run.folder.path / "none.npz")}};
  const auto clip = json_element(run.page(options), "clip-0");
  EXPECT_EQ(clip.at("motions").elements().size(), 3u);
  EXPECT_TRUE(
      clip.at("notes").elements().back().get<std::string>().starts_with("the truth cannot be shown: "));
}

/// Clusters of stiff bodies that stand, travel and rise.
pipeline::options::Clusters some_clusters() {
  std::vector<pipeline::options::NamedFeatures> motions;
  for (int i = 0; i < 6; ++i) {
    pipeline::options::MotionFeatures f{};
    f[pipeline::options::kRootHeight] = 0.9 + 0.01 * i;
    for (int j = 0; j < kBodies; ++j)
      f[pipeline::options::kPlanarVelocity + j] = i % 2 == 0 ? 0.0 : 1.0 + 0.1 * i;
    motions.push_back({"motion " + std::to_string(i), f});
  }
  pipeline::options::ClusterConfig settings;
  settings.clusters = 2;
  return pipeline::options::cluster_motions(motions, settings);
}

TEST(RunReport, MapsTheClipsWhereClustersAreKnown) {
  Folder run(2);
  EXPECT_FALSE(json_element(run.page(), "data").contains("map"));
  pipeline::options::write_clusters(run.run.clusters(), some_clusters());
  const auto map = json_element(run.page(), "data").at("map");
  EXPECT_EQ(map.at("trained").elements().size(), 6u);
  ASSERT_EQ(map.at("clips").elements().size(), 2u);
  for (int row = 0; row < 2; ++row) {
    const auto& clip = map.at("clips").at(static_cast<std::size_t>(row));
    EXPECT_EQ(clip.at(3).get<int>(), row);
    EXPECT_EQ(clip.at(2).get<int>(), 0) << "who stands is with the calm ones";
  }
  const std::filesystem::path others = run.folder.path / "others.json";
  pipeline::options::write_clusters(others, some_clusters());
  std::filesystem::remove(run.run.clusters());
  EXPECT_EQ(json_element(run.page({.map = pipeline::map_among({others})}), "data").at("map").dump(),
            map.dump());
}

TEST(RunReport, UnreadableClustersOmitOnlyTheMap) {
  Folder run(1);
  pipeline::options::Clusters older = some_clusters();
  for (auto& cluster : older.clusters) cluster.features.clear();
  for (const auto& [text, reason] :
       {std::pair<std::string, std::string>{"{}", "the options' clusters.json cannot be read"},
        {pipeline::options::format_clusters(older),
         "the options' clusters.json does not have their features"}}) {
    write_file_atomically(run.run.clusters(), text);
    const std::string page = run.page();
    const auto data = json_element(page, "data");
    EXPECT_FALSE(data.contains("map"));
    EXPECT_EQ(data.at("run").elements().back().at("name").get<std::string>(), "no map of the motions");
    EXPECT_EQ(data.at("run").elements().back().at("value").get<std::string>(), reason);
    EXPECT_FALSE(json_element(page, "clip-0").at("motions").elements().empty());
  }
}

TEST(RunReport, ShowsOptionsAndCameraDetections) {
  Folder run(1);
  record::SequenceEntry entry = run.manifest.sequences[0];
  entry.arrangement = {{0, 2}, {4, 1}};
  run.manifest.put(entry);
  motion::Clip clip = raised(0.001);
  clip.keypoints.emplace();
  clip.keypoints->names = {"pelvis"};
  clip.keypoints->uvc.assign(kRunFrames, {Vector3d(10.0, 20.0, 0.5)});
  clip.keypoints->intrinsics << 100, 0, 10, 0, 100, 20, 0, 0, 1;
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  pose.topRows<3>() << 1, 0, 0, 0, 0, 0, -1, 0.9, 0, 1, 0, 4.0;
  clip.keypoints->extrinsics.assign(1, pose);
  Folder::write(run.run.root / entry.output, clip);
  const auto shown = json_element(run.page(), "clip-0");
  EXPECT_EQ(shown.at("options").get<std::vector<std::vector<int>>>(),
            (std::vector<std::vector<int>>{{0, 3, 2}, {4, 5, 1}}));
  EXPECT_EQ(shown.at("camera").at("extrinsics").elements().size(), 1u);
  const auto& charts = shown.at("charts").elements();
  const bool told = std::any_of(charts.begin(), charts.end(), [](const record::Json& chart) {
    return chart.at("title").at("words").get<std::string>() == "distance from the keypoints" &&
           chart.at("lines").elements().size() == 3u;
  });
  EXPECT_TRUE(told);
  // A body that stands 50 mm higher is seen 50 / 4000 · 100 px higher.
  for (const auto& chart : charts)
    if (chart.at("title").at("words").get<std::string>() == "distance from the keypoints") {
      const double input = chart.at("lines").at(0).at("values").at(0),
                   cleaned = chart.at("lines").at(2).at("values").at(0);
      EXPECT_NEAR(std::abs(input - cleaned), 0.1 * 49.0 / 4.0, 0.05);
    }
  // Through a camera that was told to stand 50 mm higher, too, the input is seen where the reference is.
  motion::Clip of_input = clip;
  for (Vector3d& place : of_input.trans) place.z() += 0.049;
  of_input.keypoints->extrinsics[0](1, 3) += 0.05;
  Folder::write(run.run.input("clip 0"), of_input);
  const auto own = json_element(run.page(), "clip-0");
  EXPECT_NEAR(own.at("camera").at("told").at("extrinsics").at(0).at(7).get<double>(), 0.95, 1e-9);
  for (const auto& chart : own.at("charts").elements())
    if (chart.at("title").at("words").get<std::string>() == "distance from the keypoints") {
      const double input = chart.at("lines").at(0).at("values").at(0),
                   reference = chart.at("lines").at(1).at("values").at(0);
      EXPECT_NEAR(input, reference, 1e-3);
    }
  of_input.keypoints->extrinsics = clip.keypoints->extrinsics;
  Folder::write(run.run.input("clip 0"), of_input);
  EXPECT_FALSE(json_element(run.page(), "clip-0").at("camera").contains("told"))
      << "it was cleaned with the same";
}

// A body at rest on which nothing pushes: its weight is unexplained.
TEST(RunReport, ShowsTheUnexplainedForceOfABodyOfKnownJoints) {
  Folder run(1);
  const motion::Clip clip = test::on_uneven_joints(raised(0.0));
  files::VectorRows torques(kRunFrames);
  files::WrenchRows wrenches(kRunFrames);
  std::vector<motion::ReferenceFrame> still(kRunFrames);
  for (std::size_t t = 0; t < kRunFrames; ++t) {
    torques[t].fill(Vector3d::Zero());
    wrenches[t].fill(Vector6d::Zero());
    still[t].v_root.setZero();
    still[t].omega.fill(Vector3d::Zero());
  }
  const auto precision = files::Precision::kFloat64;
  motion::write_clip(run.run.root / run.manifest.sequences[0].output, clip,
                     {{"velocities", files::velocities_member(still, precision)},
                      {"joint_torques", files::joints_member(torques, precision)},
                      {"range_torques", files::joints_member(torques, precision)},
                      {"ground_wrenches", files::wrenches_member(wrenches, precision)},
                      {"self_contact_wrenches", files::wrenches_member(wrenches, precision)}});
  const auto shown = json_element(run.page(), "clip-0");
  int found = 0;
  for (const auto& chart : shown.at("charts").elements()) {
    if (chart.at("title").at("words").get<std::string>() != "unexplained force") continue;
    for (const auto& line : chart.at("lines").elements()) {
      if (line.at("who").get<std::string>() != "cleaned") continue;
      ++found;
      const double weight = kGravity * motion::character_of(clip).total_mass();
      EXPECT_NEAR(line.at("values").at(1).get<double>(), weight, 0.01 * weight);
    }
  }
  EXPECT_EQ(found, 1);
}

TEST(RunReport, ShowsWallClockTimesOnlyOnRequest) {
  Folder run(1);
  write_file_atomically(run.run.timing(),
                        "{\"sequences\": [{\"name\": \"clip 0\", \"seconds\": 125.0, "
                        "\"planning_seconds\": 2.0, \"training_seconds\": 0.0, \"threads\": 2}]}");
  EXPECT_EQ(run.page().find("2 min 5 s"), std::string::npos);
  ReportOptions options;
  options.times = true;
  EXPECT_NE(run.page(options).find("2 min 5 s"), std::string::npos);
}

}  // namespace
}  // namespace mimicx::report
