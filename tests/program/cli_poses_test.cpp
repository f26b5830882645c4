#include <fstream>
#include <sstream>
#include <tuple>

#include "core/npz/npz.h"
#include "import/bvh_write.h"
#include "import/motion_file.h"
#include "motion/synthetic_clip.h"
#include "program/cli.h"
#include "record/json.h"

namespace mimicx::program {
namespace {

motion::Clip synthetic(const std::string& kind) { return test::synthetic_clip(kind, 501); }

/// A squat of a body model that is not ours, moved by `shift` (m).
void write_foreign_squat(const std::filesystem::path& file, const Vector3d& shift) {
  motion::Clip clip = synthetic("squat");
  clip.body_model = "smplx";
  for (Vector3d& p : clip.trans) p += shift;
  motion::write_clip(file, clip);
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::stringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

/// A folder of one good motion, one that hovers, a BVH and a broken file.
struct CliPoses : Cli {
  void SetUp() override {
    std::filesystem::create_directory(path("in"));
    motion::Clip clip = synthetic("squat");
    motion::write_clip(path("in/good.npz"), clip);
    for (Vector3d& p : clip.trans) p.z() += 0.1;
    motion::write_clip(path("in/hover.npz"), clip);
    import::write_motion(path("in/walk.bvh"), synthetic("walk"));
    std::ofstream(path("in/bad.npz")) << "PK nonsense";
  }
};

TEST_F(CliPoses, TellsEqualNamesApart) {
  std::filesystem::create_directories(path("other"));
  std::filesystem::copy_file(path("in/good.npz"), path("other/good.npz"));
  const Call call = mimicx("audit --poses " + path("in/good.npz") + " " + path("other/good.npz"));
  EXPECT_TRUE(says(call, "\ngood  ")) << call.text;
  EXPECT_TRUE(says(call, "\ngood-2  ")) << call.text;
}

TEST_F(CliPoses, WritesARowPerMotionAndFrameAndSkipsFailures) {
  const Call call = mimicx("audit --poses " + path("in") + " --csv " + path("a.csv") + " --frames-csv " +
                           path("f.csv") + " --json " + path("a.json"));
  EXPECT_EQ(call.status, 1) << call.text;
  EXPECT_TRUE(says(call, "bad.npz: left out: ")) << call.text;
  EXPECT_TRUE(says(call, "the body hovers; ")) << call.text;
  const auto rows = split(read_file(path("a.csv")), '\n');
  ASSERT_EQ(rows.size(), 5u);
  const auto head = split(rows[0], ',');
  const auto cell = [&](int row, const std::string& name) {
    const auto cells = split(rows.at(static_cast<std::size_t>(row)), ',');
    return cells.at(static_cast<std::size_t>(std::find(head.begin(), head.end(), name) - head.begin()));
  };
  EXPECT_NE(rows[1].find("bad.npz,,"), std::string::npos);
  EXPECT_NE(rows[1].find("left out"), std::string::npos);
  for (int row = 2; row <= 4; ++row)
    EXPECT_EQ(split(rows.at(static_cast<std::size_t>(row)), ',').size(), head.size());
  EXPECT_EQ(cell(2, "file"), path("in/good.npz"));
  EXPECT_EQ(cell(2, "infeasible_share"), "0");
  EXPECT_EQ(cell(3, "infeasible_share"), "1");
  EXPECT_EQ(cell(3, "longest_wrong"), "hovers");
  EXPECT_NEAR(std::stod(cell(3, "force_mean_N")), std::stod(cell(3, "weight_N")),
              0.05 * std::stod(cell(3, "weight_N")));
  for (const int row : {2, 3, 4})
    EXPECT_LT(std::stod(cell(row, "slip")), 0.2) << "exact motions hardly slide, in the air neither";
  EXPECT_EQ(cell(1, "slip_share"), "");
  EXPECT_LT(std::stod(cell(4, "infeasible_share")), 0.1) << "the BVH of an exact walk";
  const auto frames = split(read_file(path("f.csv")), '\n');
  const int expected =
      std::stoi(cell(2, "frames")) + std::stoi(cell(3, "frames")) + std::stoi(cell(4, "frames"));
  EXPECT_EQ(frames.size(), static_cast<std::size_t>(expected) + 1);
  for (const std::string& line : frames) EXPECT_EQ(split(line, ',').size(), split(frames[0], ',').size());
  const auto json = record::Json::parse(read_file(path("a.json")));
  EXPECT_EQ(json.at("files").elements().size(), 4u);
  EXPECT_EQ(json.at("files").at(2).at("summary").at("hovers_share").get<double>(), 1.0);
}

TEST_F(CliPoses, ThreadsDoNotChangeABit) {
  for (const char* threads : {"1", "2", "3"})
    mimicx("audit --poses " + path("in") + " --threads " + threads + " --csv " + path("a") + threads +
           " --frames-csv " + path("f") + threads);
  for (const char* threads : {"2", "3"}) {
    EXPECT_EQ(read_file(path("a1")), read_file(path("a") + threads));
    EXPECT_EQ(read_file(path("f1")), read_file(path("f") + threads));
  }
}

TEST_F(CliPoses, NeverOverwritesInputsOrLeavesPartialFiles) {
  const std::string good = path("in/good.npz"), before = read_file(good);
  for (const std::string& arguments :
       {"--csv " + good, "--frames-csv " + good, "--json " + good, "--csv " + path("in/../in/good.npz"),
        "--csv " + path("x") + " --frames-csv " + path("x")}) {
    const Call call = mimicx("audit --poses " + good + " " + arguments);
    EXPECT_EQ(call.status, 2) << arguments << call.text;
    EXPECT_EQ(read_file(good), before);
  }
  EXPECT_EQ(mimicx("audit " + good + " --csv " + path("x")).status, 2) << "--csv is for --poses";
  EXPECT_EQ(mimicx("audit --poses " + good + " --reach-mm -1").status, 2);
  const Call nowhere = mimicx("audit --poses " + good + " --csv " + path("none/x.csv"));
  EXPECT_EQ(nowhere.status, 1);
  EXPECT_TRUE(says(nowhere, "expected a writable file")) << nowhere.text;
  EXPECT_FALSE(std::filesystem::exists(path("x")));
  for (const auto& entry : std::filesystem::directory_iterator(folder.path))
    EXPECT_NE(entry.path().extension(), ".mimicx-tmp") << entry.path();
}

TEST_F(CliPoses, JsonGoesToStandardOutputAndTheTableElsewhere) {
  const std::string good = path("in/good.npz");
  const Call call =
      shell(std::string(MIMICX_BINARY) + " audit --poses " + good + " --json - 2>" + path("table"));
  EXPECT_EQ(call.status, 0) << call.text;
  EXPECT_EQ(call.text[0], '{') << call.text.substr(0, 80);
  EXPECT_TRUE(read_file(path("table")).find("good") != std::string::npos);
  EXPECT_FALSE(std::filesystem::exists("-"));
}

TEST_F(CliPoses, ALimitOfFileSizesEndsInALine) {
  const std::string good = path("in/good.npz");
  const Call call = shell("bash -c 'ulimit -f 1; " + std::string(MIMICX_BINARY) + " convert " + good + " " +
                          path("big.csv") + "' 2>&1");
  EXPECT_EQ(call.status, 1) << call.text;
  EXPECT_TRUE(says(call, "big.csv: expected a writable file, found File too large")) << call.text;
}

TEST_F(CliPoses, UsesTheGivenFloorAndElseDetectsIt) {
  write_foreign_squat(path("foreign.npz"), {0, 0, 0.3});
  const Call looked_for = mimicx("audit --poses " + path("foreign.npz"));
  EXPECT_FALSE(says(looked_for, "hovers")) << looked_for.text;
  const Call said = mimicx("audit --poses " + path("foreign.npz") + " --floor 0");
  EXPECT_TRUE(says(said, "hovers")) << said.text;
}

TEST_F(CliPoses, SaysHowAFileWasReadWhereMoreThanItsFormatWasDecided) {
  write_foreign_squat(path("foreign.npz"), {300, 0, 0});
  const Call call = mimicx("audit --poses " + path("foreign.npz"));
  EXPECT_TRUE(says(call, path("foreign.npz") + ": place: moved by (-300, 0) m to the origin")) << call.text;
  EXPECT_FALSE(says(mimicx("audit --poses " + path("in/good.npz")), path("in/good.npz") + ": "));
}

TEST_F(CliPoses, HelpBeginsWithTwoExamples) {
  const std::string help = mimicx("audit --help").text;
  EXPECT_LT(help.find("mimicx audit out/run/motions"), help.find("mimicx audit --poses DIR --csv"));
  EXPECT_LT(help.find("mimicx audit --poses DIR --csv"), help.find("Usage:"));
}

/// Truths a, b, c; motions a (moved by 0.1 m) and b (moved by 2 m).
struct CliProtocol : Cli {
  void SetUp() override {
    for (const char* folder : {"truth", "motions"}) std::filesystem::create_directory(path(folder));
    for (const auto& [name, metres] : {std::pair{"a", 0.1}, {"b", 2.0}, {"c", 0.0}}) {
      motion::Clip clip = synthetic("walk");
      motion::write_clip(path(std::string("truth/") + name + ".npz"), clip);
      for (Vector3d& p : clip.trans) p.x() += metres;
      if (metres > 0.0) motion::write_clip(path(std::string("motions/") + name + ".npz"), clip);
    }
  }
};

TEST_F(CliProtocol, MissingMotionIsNoSuccess) {
  const Call call = mimicx("evaluate --protocol phc --truth " + path("truth") + " --motions " +
                           path("motions") + " --json " + path("p.json"));
  EXPECT_EQ(call.status, 1) << call.text;
  EXPECT_TRUE(says(call, "motions/c: left out: ")) << call.text;
  EXPECT_TRUE(says(call, "over 0.5 m")) << call.text;
  const auto folder = record::Json::parse(read_file(path("p.json"))).at("folders").at(0);
  EXPECT_NEAR(folder.at("pooled").at("Succ").at("value").get<double>(), 100.0 / 3.0, 1e-9);
  EXPECT_NEAR(folder.at("pooled").at("E_g-mpjpe").at("value").get<double>(), 1050.0, 1e-6);
  EXPECT_NEAR(folder.at("succeeded").at("E_g-mpjpe").at("value").get<double>(), 100.0, 1e-6);
}

TEST_F(CliProtocol, PrintsTheProtocolsColumnsAndALinePerFolder) {
  std::filesystem::remove(path("truth/c.npz"));
  for (const auto& [protocol, column, source] : {std::tuple{"phc", "E_pa-mpjpe", "after SMPLSim "},
                                                 {"pmr", "Float", "after arXiv 2412.17377"},
                                                 {"emdb", "WA-MPJPE", "after WHAM "}}) {
    const std::string arguments =
        std::string("evaluate --protocol ") + protocol + " --truth " + path("truth");
    const Call call = mimicx(arguments + " --motions " + path("motions"));
    EXPECT_EQ(call.status, 0) << call.text;
    EXPECT_TRUE(says(call, column) && says(call, "pooled") && says(call, source)) << call.text;
    const Call two = mimicx(arguments + " --motions " + path("motions") + " " + path("truth"));
    EXPECT_EQ(two.status, 0) << two.text;
    EXPECT_TRUE(says(two, path("motions")) && says(two, path("truth"))) << two.text;
  }
}

TEST_F(CliProtocol, RejectsOtherRatesAndProtocols) {
  motion::Clip clip = synthetic("walk");
  clip.fps = 60.0;
  for (const char* folder : {"truth/d.npz", "motions/d.npz"}) motion::write_clip(path(folder), clip);
  const std::string folders = " --truth " + path("truth") + " --motions " + path("motions");
  const Call call = mimicx("evaluate --protocol emdb" + folders);
  EXPECT_EQ(call.status, 1);
  EXPECT_TRUE(says(call, "motions/d: left out: protocols are defined at 30 frames per second")) << call.text;
  EXPECT_EQ(mimicx("evaluate --protocol mine" + folders).status, 2);
  EXPECT_EQ(
      mimicx("evaluate --protocol phc --truth " + path("none") + " --motions " + path("motions")).status, 1);
}

}  // namespace
}  // namespace mimicx::program
