#include "pipeline/report/run_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/file.h"
#include "motion/clip_file.h"
#include "pipeline/evaluate.h"
#include "pipeline/standing_clip.h"
#include "pipeline/temporary_folder.h"

namespace mimicx::pipeline::report {
namespace {

constexpr int kFrames = 6;
constexpr const char* kEmbedded = "\"application/json\" id=\"clip-";

std::size_t count(const std::string& text, const std::string& words) {
  std::size_t found = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++found;
  return found;
}

motion::Clip raised(double height) {
  motion::Clip clip = standing_clip(kFrames);
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
    entry.frames = kFrames;
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
  std::string page(const ReportOptions& options = {}) {
    write_report(run, manifest, options);
    return read_file(run.report());
  }
  TemporaryFolder folder;
  record::RunFolder run{folder.path / "run"};
  record::Manifest manifest;
};

nlohmann::json element(const std::string& page, const std::string& id) {
  const std::size_t name = page.find("id=\"" + id + "\""), begin = page.find('>', name) + 1;
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

/// [input, before training, cleaned] of a clip.
nlohmann::json values(const std::string& page, const std::string& key, std::size_t clip = 0) {
  const nlohmann::json data = element(page, "data");
  for (std::size_t k = 0; k < data["metrics"].size(); ++k)
    if (data["metrics"][k]["key"] == key) return data["rows"][clip]["values"][k];
  return nullptr;
}

TEST(RunReport, FiftyMotionsAreOneFileAndMoreStandBesideIt) {
  Folder few(50);
  const std::string one = few.page();
  EXPECT_EQ(count(one, kEmbedded), 50u);
  EXPECT_FALSE(std::filesystem::exists(few.run.root / "report"));
  few.add("clip 50", true);
  const std::string page = few.page();
  EXPECT_EQ(count(page, kEmbedded), 0u);
  EXPECT_LT(page.size(), one.size() / 2);
  const std::string script = read_file(few.run.report_clip("clip 7"));
  const std::string opening = "mimicx_clip(\"clip 7\", ";
  ASSERT_TRUE(script.starts_with(opening));
  EXPECT_EQ(nlohmann::json::parse(script.substr(opening.size(), script.size() - opening.size() - 3)),
            element(one, "clip-7"));
}

TEST(RunReport, AThousandInputsThatCouldNotBeReadAreOneFile) {
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

TEST(RunReport, AClipWhoseFilesAreGoneSaysSo) {
  Folder run(2);
  std::filesystem::remove(run.run.reference("clip 1"));
  const std::string page = run.page();
  EXPECT_FALSE(element(page, "clip-0")["motions"].empty());
  const nlohmann::json clip = element(page, "clip-1");
  EXPECT_TRUE(clip["motions"].empty());
  EXPECT_TRUE(clip["notes"].back().get<std::string>().starts_with("cannot be shown: "));
}

TEST(RunReport, OfAnOlderRunTheInputIsLeftOut) {
  Folder run(1);
  std::filesystem::remove(run.run.input("clip 0"));
  const nlohmann::json clip = element(run.page(), "clip-0");
  ASSERT_EQ(clip["motions"].size(), 2u);
  EXPECT_EQ(clip["motions"][0]["who"], "reference");
  for (const auto& bars : clip["bars"]) EXPECT_FALSE(bars["flaw"].get<bool>());
}

TEST(RunReport, TheTableHasTheManifestsNumbers) {
  Folder run(1);
  const std::string page = run.page();
  EXPECT_EQ(values(page, "Float"), (nlohmann::json{40.0, nullptr, 1.0}));
  EXPECT_EQ(values(page, "FS"), (nlohmann::json{0.0, nullptr, 0.125}));
  EXPECT_EQ(values(page, "max_distance_mm")[2], 12.0);
  EXPECT_EQ(values(page, "root_force_mean_N")[2], 0.5);
  // A body that hangs 5 cm over the floor needs its weight from nowhere, by its poses.
  EXPECT_NEAR(values(page, "root_force_mean_N")[0].get<double>(), 9.81 * make_character().total_mass(), 30.0);
  for (const motion::MetricDefinition& d : motion::metric_definitions())
    EXPECT_FALSE(values(page, d.name).is_null()) << d.name << " has no column";
}

TEST(RunReport, AgainstTheTruthItSaysWhatEvaluateSays) {
  Folder run(1);
  const std::filesystem::path truth = run.folder.path / "truth";
  Folder::write(truth / "clip 0.npz", raised(-0.002));
  ReportOptions options;
  options.truth = {{"clip 0", truth / "clip 0.npz"}};
  const std::string page = run.page(options);
  EXPECT_EQ(element(page, "clip-0")["motions"].back()["who"], "truth");
  for (const auto& [folder, column] : {std::pair{"inputs", 0}, std::pair{"motions", 2}}) {
    const Evaluation told = evaluate_folders(truth, run.run.root / folder);
    ASSERT_EQ(told.motions.size(), 1u);
    for (const char* name : {"MRPE", "gMPJPE", "MPJPE", "Accel", "FS_gt", "Float_gt"}) {
      double expected = 0.0;
      for (const motion::MetricDefinition& d : motion::metric_definitions())
        if (d.name == std::string(name)) expected = (told.motions[0].metrics.*d.value).value;
      const auto value = values(page, std::string("truth:") + name)[static_cast<std::size_t>(column)];
      EXPECT_NEAR(value.get<double>(), expected, 1e-5 * std::abs(expected) + 1e-9) << folder << ' ' << name;
    }
  }
  EXPECT_TRUE(values(run.page(), "truth:MRPE").is_null()) << "without a truth there is no such column";
}

TEST(RunReport, ATruthThatCannotBeReadIsSaid) {
  Folder run(1);
  ReportOptions options;
  options.truth = {{"clip 0", run.folder.path / "none.npz"}};
  const nlohmann::json clip = element(run.page(options), "clip-0");
  EXPECT_EQ(clip["motions"].size(), 3u);
  EXPECT_TRUE(clip["notes"].back().get<std::string>().starts_with("the truth cannot be shown: "));
}

TEST(RunReport, WallClockTimesAreThereOnlyWhereTheyAreAskedFor) {
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
}  // namespace mimicx::pipeline::report
