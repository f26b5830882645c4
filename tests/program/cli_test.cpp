// The subcommands that train, and what all of them share.
#include "program/cli.h"

#include <fstream>

#include "core/bits.h"
#include "core/file.h"
#include "core/npz/npz.h"
#include "import/bvh.h"
#include "import/bvh_write.h"
#include "import/motion_file.h"
#include "motion/clip_file.h"
#include "record/commit.h"
#include "record/json.h"
#include "record/run_folder.h"
#include "run/results.h"

namespace mimicx::program {
namespace {

TEST_F(Cli, EverySubcommandHasHelp) {
  EXPECT_EQ(mimicx("--help").status, 0);
  for (const char* command : kCommands) {
    const Call call = mimicx(std::string(command) + " --help");
    EXPECT_EQ(call.status, 0) << command;
    EXPECT_TRUE(says(call, command)) << call.text;
    EXPECT_TRUE(says(mimicx("--help"), command));
  }
}

TEST_F(Cli, VersionNamesTheInstructionSetAndTheArithmetic) {
  const Call call = mimicx("--version");
  EXPECT_EQ(call.status, 0);
  EXPECT_TRUE(says(call, std::string("built for ") + MIMICX_TARGET + ", arithmetic " + kArithmetic))
      << call.text;
}

TEST_F(Cli, VersionAndManifestNameTheCommit) {
  const std::string commit = record::commit();
  EXPECT_EQ(first_match(commit, "^(unknown|[0-9a-f]{12}(-dirty)?)$"), commit);
  const std::string plain = commit.substr(0, commit.find('-'));
  EXPECT_TRUE(plain == "unknown" ||
              shell("git -C '" MIMICX_SOURCE_DIR "' cat-file -e " + plain + " 2>&1").status == 0)
      << commit;
  EXPECT_TRUE(says(mimicx("--version"), std::string(MIMICX_VERSION) + " (" + commit + ")")) << commit;
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  EXPECT_EQ(mimicx("plan " + path("a.npz") + " --out " + path("out") + " --no-fit").status, 0);
  EXPECT_TRUE(read_file(path("out/manifest.json")).find("\"commit\": \"" + commit) != std::string::npos);
}

TEST_F(Cli, WrongUsageIsStatusTwo) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  const std::string a = path("a.npz"), out = " --out " + path("out");
  for (const std::string& arguments : {std::string(),
                                       std::string("dance"),
                                       std::string("imitate"),
                                       "imitate" + out,
                                       "imitate " + a + out + " --samples -1",
                                       "imitate " + a + out + " --samples many",
                                       "imitate " + a + out + " --threads 0",
                                       "imitate " + a + out + " --limit-seconds -1",
                                       "imitate " + a + out + " --frobnicate",
                                       "imitate " + a + out + " --set gamma",
                                       "imitate " + a + out + " --set gamma=2",
                                       "imitate " + a + out + " --set epochs=0",
                                       "imitate " + a + out + " --set characters=100",
                                       "adapt " + a + out + " --switch-penalty 1",
                                       "adapt " + a + out + " --switch-penalty nan",
                                       "adapt " + a + out + " --rescue-reward 1.5",
                                       "adapt " + a + out + " --rescue-reward nan",
                                       "adapt " + a + out + " --selector best",
                                       "adapt " + a + out + " --set selector=4",
                                       "adapt " + a + out + " --set selector=0.5",
                                       "adapt " + a + out + " --set beam_width=0",
                                       "run " + a + out + " --rescue-reward -1",
                                       std::string("plan"),
                                       "plan " + a + out + " --samples 1",
                                       "plan " + a + out + " --set plan_horizon=0",
                                       "plan " + a + out + " --set gamma=0.9",
                                       "adapt " + a + out + " --method dance",
                                       "adapt " + a + out + " --method plan --set gamma=0.9",
                                       "adapt " + a + out + " --method options --set plan_horizon=5",
                                       std::string("evaluate"),
                                       std::string("info"),
                                       "convert " + a,
                                       "convert " + a + " " + path("b.fbx"),
                                       "convert " + a + " " + path("b.npz") + " --rate 25",
                                       "info " + a + " --up w",
                                       "info " + a + " --scale 0",
                                       "info " + a + " --body mine",
                                       "info " + a + " --smplx " + path("none.npz"),
                                       std::string("synth"),
                                       std::string("synth --kinds wave --out ''"),
                                       "synth --kinds wave --seed -1" + out,
                                       "imitate " + a + out + " --seed -1",
                                       "imitate " + a + " --out ''",
                                       "cluster " + a + " --out ''",
                                       "info " + a + " --fps 0.01",
                                       std::string("audit"),
                                       std::string("export-mjcf"),
                                       "export-mjcf " + path("c.xml") + " --betas 6",
                                       "export-mjcf " + path("c.xml") + " --betas 0,0,0,0,0,0,0,0,0,0,0",
                                       "export-mjcf " + path("c.xml") + " --betas 1 --motion " + a,
                                       std::string("cluster"),
                                       "cluster " + a,
                                       "cluster " + a + out + " --radius -1",
                                       "cluster " + a + out + " --clusters 0",
                                       "cluster " + a + out + " --clusters 2",
                                       "cluster " + a + out + " --clusters 1 --radius 2"}) {
    const Call call = mimicx(arguments);
    EXPECT_EQ(call.status, 2) << "mimicx " << arguments << '\n' << call.text;
    EXPECT_FALSE(call.text.empty());
  }
}

TEST_F(Cli, ConfigPrintsTheDefaultsThatHelpNames) {
  const auto json = record::Json::parse(mimicx("config --json").text);
  for (const auto& [command, option, setting] :
       std::vector<std::array<std::string, 3>>{{"imitate", "--samples", "samples"},
                                               {"adapt", "--budget-samples", "samples"},
                                               {"adapt", "--switch-penalty", "switch_penalty"},
                                               {"adapt", "--rescue-reward", "rescue_reward"},
                                               {"adapt", "--seed", "seed"},
                                               {"pretrain small", "--samples", "samples"},
                                               {"pretrain small", "--radius", "cluster_radius"}}) {
    const double value = json.at(command).at(setting);
    const Call help = mimicx(command.substr(0, command.find(' ')) + " --help");
    const std::size_t at = help.text.find(option + " ", help.text.find("Options:"));
    ASSERT_NE(at, std::string::npos) << command << ' ' << option;
    const std::string line = help.text.substr(at, help.text.find('\n', at) - at);
    const std::size_t before_default = line.find_last_of("=[");  // versions of CLI11 differ
    ASSERT_NE(before_default, std::string::npos) << line;
    EXPECT_EQ(std::stod(line.substr(before_default + 1)), value) << line;
  }
  const Call table = mimicx("config");
  EXPECT_EQ(table.status, 0);
  EXPECT_TRUE(says(table, "pretrain large") && says(table, "pretrain printed") &&
              says(table, "switch_penalty"))
      << table.text;
}

TEST_F(Cli, FormerNameOfAMethodIsAcceptedAndSaid) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  const std::string rest = " --budget-samples 0 --threads 1 --out " + path("out") + " " + path("a.npz");
  const Call former = mimicx("adapt --method paper" + rest);
  EXPECT_EQ(former.status, 0) << former.text;
  EXPECT_TRUE(says(former, "--method paper is called options now\n"));
  const std::string manifest = read_file(path("out/manifest.json"));
  EXPECT_NE(manifest.find("\"method\": \"options\""), std::string::npos);
  EXPECT_EQ(manifest.find("\"paper\""), std::string::npos);
  const Call continued = mimicx("adapt --method options" + rest);
  EXPECT_EQ(continued.status, 0) << continued.text;
  EXPECT_FALSE(says(continued, "is called"));
  EXPECT_EQ(read_file(path("out/manifest.json")), manifest) << "the motion is done, under today's name";
}

TEST_F(Cli, MethodAsPrintedChangesDefaultsAndEachCanBeChangedBack) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  const auto settings_of_run = [&](const std::string& command, const std::string& out) {
    const Call call = mimicx(command + " --threads 1 --out " + path(out));
    EXPECT_TRUE(std::filesystem::exists(path(out) + "/manifest.json")) << call.text;
    return record::Json::parse(read_file(path(out) + "/manifest.json")).at("run").at("settings");
  };
  const std::string pretrain = "pretrain --clusters 1 --samples 0 --no-encoder " + path("a.npz");
  const auto options = settings_of_run(pretrain + " --method printed", "options");
  EXPECT_EQ(options.at("residual_actions").get<double>(), 0);
  EXPECT_TRUE(options.at("as_is").get<bool>());
  const auto undone = settings_of_run(
      pretrain + " --preset paper --no-as-is --fit --method printed --set residual_actions=1", "residual");
  EXPECT_EQ(undone.at("hidden_4").get<double>(), 256) << "the former name of the preset large";
  EXPECT_EQ(undone.at("residual_actions").get<double>(), 1);
  EXPECT_FALSE(undone.at("as_is").get<bool>());
  EXPECT_TRUE(undone.at("fit").get<bool>());
  EXPECT_EQ(undone.at("reward_target").get<double>(), 0);
  const std::string adapt = "adapt " + path("a.npz") + " --budget-samples 0 --options " + path("options");
  EXPECT_EQ(settings_of_run(adapt + " --method printed", "dp").at("selector").get<double>(), 0);
  EXPECT_EQ(settings_of_run(adapt + " --method printed --selector beam", "beam").at("selector").get<double>(),
            1);
  EXPECT_EQ(
      settings_of_run(adapt + " --selector beam --method printed", "beam_first").at("selector").get<double>(),
      1)
      << "wherever the method stands on the line";
}

TEST_F(Cli, ManifestRecordsTheSelectorsSettings) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  mimicx("adapt " + path("a.npz") +
         " --budget-samples 0 --threads 1 --switch-penalty -0.5 --rescue-reward 0.25 --selector single" +
         " --set rescue_frames=12 --set beam_width=3" + " --out " + path("out"));
  const auto manifest = record::Json::parse(read_file(path("out/manifest.json")));
  EXPECT_EQ(manifest.at("run").at("settings").at("switch_penalty").get<double>(), -0.5);
  EXPECT_EQ(manifest.at("run").at("settings").at("rescue_reward").get<double>(), 0.25);
  EXPECT_EQ(manifest.at("run").at("settings").at("selector").get<double>(), 2);
  EXPECT_EQ(manifest.at("run").at("settings").at("rescue_frames").get<double>(), 12);
  EXPECT_EQ(manifest.at("run").at("settings").at("beam_width").get<double>(), 3);
}

TEST_F(Cli, FindsShippedOptionsByName) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  const std::filesystem::path shipped = std::filesystem::path(MIMICX_SOURCE_DIR) / "data" / "options";
  const auto taken = [&](const std::string& options, const std::string& out) {
    mimicx("adapt " + path("a.npz") + " --method options --budget-samples 0 --threads 1 " + options +
           " --out " + path(out));
    const auto manifest = record::Json::parse(read_file(path(out) + "/manifest.json"));
    return manifest.at("run").at("options").get<std::string>();
  };
  const std::string trained = record::file_checksum(shipped / "options.npz"),
                    taught = record::file_checksum(shipped / "taught" / "options.npz");
  EXPECT_EQ(taken("", "default"), trained + "+" + taught);
  EXPECT_EQ(taken("--options trained", "trained"), trained);
  EXPECT_EQ(taken("--options taught", "taught"), taught);
  EXPECT_EQ(taken("--options taught --options trained", "both"), taught + "+" + trained);
  EXPECT_EQ(taken("--options taught/options.npz", "file"), taught);
  EXPECT_TRUE(says(mimicx("adapt " + path("a.npz") + " --options no_such --out " + path("none")), "no_such"));
  EXPECT_TRUE(says(mimicx("adapt " + path("a.npz") + " --options '' --out " + path("none")), "--options"));
  EXPECT_TRUE(
      says(mimicx("adapt " + path("a.npz") + " --options taught --options taught --out " + path("none")),
           "given twice"));
}

/// What is asked for by name may lie where the user is; what is taken by default may not.
TEST_F(Cli, FolderOfAShippedNameDoesNotReplaceTheShippedOptions) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  std::filesystem::create_directory(path("taught"));
  const Call call = shell("cd '" + folder.path.string() +
                          "' && '" MIMICX_BINARY
                          "' adapt a.npz --method options --budget-samples 0 --threads 1 --out out 2>&1");
  EXPECT_EQ(call.status, 0) << call.text;
  EXPECT_NE(shell("cd '" + folder.path.string() +
                  "' && '" MIMICX_BINARY "' adapt a.npz --method options --options taught --out other 2>&1")
                .status,
            0)
      << "an empty folder of that name is there";
}

TEST_F(Cli, UnreadableFileIsNamedWithStatusOne) {
  std::ofstream(path("bad.npz")) << "PK nonsense";
  for (const std::string& arguments : {"info " + path("bad.npz"), "info " + path("none.npz"),
                                       "convert " + path("bad.npz") + " " + path("o.npz"),
                                       "imitate " + path("bad.npz") + " --out " + path("out")}) {
    const Call call = mimicx(arguments);
    EXPECT_EQ(call.status, 1) << arguments << '\n' << call.text;
    EXPECT_TRUE(says(call, ".npz")) << call.text;
  }
}

TEST_F(Cli, InterruptedTrainingContinuesToTheSameBytes) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  const std::string settings =
      " --samples 8192 --set characters=64 --set group_size=16 --set horizon=8"
      " --set minibatch=256 --set hidden_1=16 --set hidden_2=16 --out ";
  const std::string command = "imitate " + path("a.npz") + settings;
  ASSERT_EQ(mimicx(command + path("whole")).status, 0);
  // TERM: shells hide INT from what they start in the background. The handler is there before the manifest.
  const Call interrupted =
      mimicx(command + path("halves") + " 2>&1 & while [ ! -e " + path("halves/manifest.json") +
             " ]; do sleep 0.01; done; kill -TERM $!; wait $!");
  EXPECT_EQ(interrupted.status, 130) << interrupted.text;
  EXPECT_TRUE(says(interrupted, "interrupted; the same command continues")) << interrupted.text;
  ASSERT_EQ(mimicx(command + path("halves")).status, 0);
  EXPECT_EQ(run::results_of(path("halves")), run::results_of(path("whole")));
}

TEST_F(Cli, InterruptedPlanRestartsToTheSameBytes) {
  motion::write_clip(path("a.npz"), motion::standing_clip(90));
  const std::string command = "plan " + path("a.npz") + " --out ";
  ASSERT_EQ(mimicx(command + path("whole")).status, 0);
  const Call interrupted =
      mimicx(command + path("halves") + " 2>&1 & while [ ! -e " + path("halves/manifest.json") +
             " ]; do sleep 0.01; done; kill -TERM $!; wait $!");
  EXPECT_EQ(interrupted.status, 130) << interrupted.text;
  EXPECT_TRUE(says(interrupted, "interrupted; the same command continues")) << interrupted.text;
  EXPECT_FALSE(std::filesystem::exists(path("halves/motions/a.npz")));
  ASSERT_EQ(mimicx(command + path("halves")).status, 0);
  EXPECT_EQ(run::results_of(path("halves")), run::results_of(path("whole")));
}

TEST_F(Cli, AdaptTrainsNothingIfThePlanSucceeds) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  const Call call = mimicx("adapt " + path("a.npz"));
  EXPECT_EQ(call.status, 0) << call.text;
  const auto manifest = record::Json::parse(read_file(path("a.mimicx/manifest.json")));
  EXPECT_EQ(manifest.at("run").at("method").get<std::string>(), "auto");
  EXPECT_EQ(manifest.at("sequences").at(0).at("method").get<std::string>(), "plan");
  EXPECT_EQ(manifest.at("sequences").at(0).at("samples").get<int>(), 0);
  EXPECT_TRUE(std::filesystem::exists(path("a.mimicx/plans/a.npz")));
  EXPECT_TRUE(std::filesystem::exists(path("a.clean.npz")));
  EXPECT_FALSE(std::filesystem::exists(path("a.mimicx/training")));
  EXPECT_FALSE(std::filesystem::exists(path("a.mimicx/policies"))) << "nobody asked for a policy";
  EXPECT_TRUE(
      says(mimicx("adapt --method plan --policy " + path("a.npz")), "--policy: expected --method auto"));
  EXPECT_EQ(mimicx("adapt --policy --set teach_rounds=2 --set teach_hidden=16 --set polish_samples=0 " +
                   path("a.npz") + " --out " + path("policy"))
                .status,
            0);
  EXPECT_TRUE(std::filesystem::exists(path("policy/policies/a.npz")));
  EXPECT_EQ(mimicx("adapt --method options " + path("a.npz")).status, 1) << "a folder of another method";
}

TEST_F(Cli, WithoutOutTheCleanMotionIsBesideItsInput) {
  motion::write_clip(path("a.npz"), foreign_clip(60.0));
  const std::string command = "plan " + path("a.npz") + " --threads 1 --rate input";
  const Call call = mimicx(command);
  ASSERT_TRUE(std::filesystem::exists(path("a.mimicx/manifest.json"))) << call.text;
  const auto manifest = record::Json::parse(read_file(path("a.mimicx/manifest.json")));
  const auto& entry = manifest.at("sequences").at(0);
  EXPECT_NE(entry.at("decisions").dump().find("up axis: y"), std::string::npos)
      << entry.at("decisions").dump();
  ASSERT_EQ(entry.at("status").get<std::string>(), "ok") << call.text;
  const motion::Clip input = motion::read_clip(path("a.npz")), clean = motion::read_clip(path("a.clean.npz"));
  EXPECT_EQ(clean.body_model, "smplx");
  EXPECT_EQ(clean.fps, 60.0);
  EXPECT_EQ(clean.frames(), input.frames());
  EXPECT_EQ(read_npz(path("a.clean.npz")).at("pose_hand").bytes,
            read_npz(path("a.npz")).at("pose_hand").bytes);
  EXPECT_EQ(mimicx(command).status, 0) << "the same command keeps what is there";
  // A folder stands for its inputs, not for clean copies.
  EXPECT_FALSE(
      says(mimicx("cluster " + folder.path.string() + " --clusters 1 --out " + path("c.json")), "- a.clean"));
}

TEST_F(Cli, BvhInputGivesACleanBvh) {
  import::write_bvh(path("clip.bvh"), motion::standing_clip(40));
  const Call call = mimicx("imitate " + path("clip.bvh") + " --samples 1 --threads 1");
  ASSERT_TRUE(std::filesystem::exists(path("clip.mimicx/motions/clip.npz"))) << call.text;
  EXPECT_EQ(call.status, 0);
  const motion::Clip clean = import::read_motion(path("clip.clean.bvh"));
  EXPECT_EQ(clean.frames(), 40);
  EXPECT_EQ(clean.fps, 30.0);
  const auto simulated = motion::poses_of(motion::read_clip(path("clip.mimicx/motions/clip.npz"))),
             back = motion::poses_of(clean);
  for (std::size_t j = 0; j < kBodies; ++j)
    EXPECT_LT((simulated[20].p_WB[j] - back[20].p_WB[j]).norm(), 1e-6) << j;
}

TEST_F(Cli, RejectsARunOfOtherReadOptions) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  const std::string command = "imitate " + path("a.npz") + " --samples 0 --threads 1 --out " + path("out");
  mimicx(command);
  EXPECT_EQ(mimicx(command + " --fps 25").status, 2);
}

TEST_F(Cli, ImitateContinuesAfterAFailedInput) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  const std::string command =
      "imitate " + path("none.npz") + " " + path("a.npz") + " --samples 1 --threads 1 --out " + path("out");
  const Call call = mimicx(command);
  EXPECT_EQ(call.status, 1) << call.text;
  EXPECT_TRUE(std::filesystem::exists(path("out/motions/a.npz"))) << call.text;
  const auto manifest = record::Json::parse(read_file(path("out/manifest.json")));
  ASSERT_EQ(manifest.at("sequences").elements().size(), 2u);
  EXPECT_EQ(manifest.at("sequences").at(0).at("status").get<std::string>(), "failed");
  EXPECT_EQ(manifest.at("sequences").at(1).at("input").get<std::string>(), path("a.npz"));
  EXPECT_EQ(mimicx(command + " --seed 2").status, 2) << "a folder of another seed";
}

TEST_F(Cli, UnreadableFolderDoesNotStopTheOthers) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  motion::write_clip(path("one.npz"), motion::standing_clip(1));
  std::filesystem::create_symlink(path("loop.npz"), path("loop.npz"));
  std::filesystem::create_directory(path("empty"));
  std::filesystem::create_directory(path("locked"));
  std::filesystem::permissions(path("locked"), std::filesystem::perms::none);
  const Call call =
      mimicx("imitate " + path("empty") + " " + path("loop.npz") + " " + path("locked/b.npz") + " " +
             path("one.npz") + " " + path("a.npz") + " --samples 1 --threads 1 --out " + path("out"));
  std::filesystem::permissions(path("locked"), std::filesystem::perms::owner_all);
  EXPECT_EQ(call.status, 1) << call.text;
  EXPECT_TRUE(says(call, path("empty") + ": expected a file, found a folder")) << call.text;
  EXPECT_TRUE(says(call, path("loop.npz") + ": expected a readable file, found Too many")) << call.text;
  EXPECT_TRUE(says(call, path("one.npz") + ": expected at least 2 frames, found 1")) << call.text;
  EXPECT_TRUE(std::filesystem::exists(path("out/motions/a.npz"))) << call.text;
}

TEST_F(Cli, UnwritableOutputFolderDoesNotStopTheOthers) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  motion::write_clip(path("b.npz"), motion::standing_clip(20));
  std::ofstream(path("a.mimicx")) << "in the way";
  const Call call = mimicx("imitate " + path("a.npz") + " " + path("b.npz") + " --samples 1 --threads 1");
  EXPECT_EQ(call.status, 1) << call.text;
  EXPECT_TRUE(says(call, path("a.npz") + ": left out: ")) << call.text;
  EXPECT_TRUE(std::filesystem::exists(path("b.clean.npz"))) << call.text;
}

}  // namespace
}  // namespace mimicx::program
