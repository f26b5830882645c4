// The command line itself: help, numbers, mistyped words, what is said of a wrong value.

#include "core/file.h"
#include "program/cli.h"
#include "record/json.h"

namespace mimicx::program {
namespace {

TEST_F(Cli, HelpBeginsWithTwoExamplesWhoseOptionsItExplains) {
  for (const std::string command : kCommands) {
    const Call call = mimicx(command + " --help");
    const std::vector<std::string> lines = lines_of(call.text);
    ASSERT_GT(lines.size(), 3u) << command;
    for (const std::size_t k : {0u, 1u}) {
      EXPECT_TRUE(lines[k].starts_with("  mimicx " + command + " ") || lines[k] == "  mimicx " + command)
          << lines[k];
      const std::string rest = call.text.substr(call.text.find("Usage:"));
      std::string line = lines[k];
      for (std::string option; !(option = first_match(line, "--[a-z-]+")).empty();) {
        EXPECT_NE(rest.find(option), std::string::npos) << command << ": " << option;
        line.erase(0, line.find(option) + option.size());
      }
    }
    EXPECT_EQ(lines[2], "") << command;
  }
}

TEST_F(Cli, HelpFitsATerminalWithoutLibraryWording) {
  for (const std::string command : kCommands) {
    const Call call = mimicx(command + " --help");
    for (const char* foreign : {"ENUM", "FLOAT", "UINT", "TEXT", " in [", " in {", "REQUIRED", "Excludes"})
      EXPECT_FALSE(says(call, foreign)) << command << ": " << foreign << '\n' << call.text;
    EXPECT_EQ(first_match(call.text, "[0-9]{12}"), "") << call.text;
    for (const std::string& line : lines_of(call.text)) EXPECT_LE(line.size(), 100u) << line;
  }
}

TEST_F(Cli, SuggestsACorrectionForAMistypedWord) {
  EXPECT_TRUE(says(mimicx("adpt a.npz --out b"), "unknown command adpt: did you mean adapt?"));
  EXPECT_TRUE(says(mimicx("evalaute"), "did you mean evaluate?"));
  EXPECT_TRUE(says(mimicx("imitate a.npz --sampels 3"), "unknown option --sampels: did you mean --samples?"));
  EXPECT_TRUE(says(mimicx("plan a.npz --no-fitt"), "did you mean --no-fit?"));
  EXPECT_TRUE(says(mimicx("synth --kinds wvae --out b"), "found wvae"));
  const Call nothing = mimicx("frobnicate");
  EXPECT_TRUE(says(nothing, "unknown command frobnicate") && !says(nothing, "mean")) << nothing.text;
}

TEST_F(Cli, AcceptsThousandsAndMillionsSuffixes) {
  for (const auto& [text, samples] : std::vector<std::pair<std::string, std::int64_t>>{
           {"3M", 3'000'000}, {"500k", 500'000}, {"1.5M", 1'500'000}, {"2e4", 20'000}, {"7", 7}}) {
    const std::string out = path(text);
    EXPECT_EQ(mimicx("imitate " + path("none.npz") + " --samples " + text + " --out " + out).status, 1);
    const auto manifest = record::Json::parse(read_file(out + "/manifest.json"));
    EXPECT_EQ(manifest.at("run").at("samples").get<std::int64_t>(), samples) << text;
  }
  for (const char* text : {"3 M", "M", "0.5", "1.5", "k3", "1e400", "99999999999M", "0x10"})
    EXPECT_EQ(mimicx("imitate " + path("none.npz") + " --samples '" + text + "'").status, 2) << text;
}

TEST_F(Cli, AFileForTheOutputFolderIsWrongUsage) {
  write_file_atomically(path("file"), "x");
  for (const std::string command :
       {"plan a.npz", "fit a.npz", "synth", "corrupt a.npz --kinds jitter", "pretrain a.npz"}) {
    const Call call = mimicx(command + " --out " + path("file"));
    EXPECT_EQ(call.status, 2) << command;
    EXPECT_TRUE(says(call, "--out: expected a folder, found " + path("file"))) << call.text;
  }
}

TEST_F(Cli, BadValueErrorIsOneLineWithTheExpectedValue) {
  for (const auto& [arguments, said] : std::vector<std::pair<std::string, std::string>>{
           {"imitate a --samples -1", "--samples: expected a whole number from 0 on, found -1"},
           {"imitate a --seed -1", "--seed: expected a whole number from 0 on, found -1"},
           {"imitate a --threads 0", "--threads: expected a whole number from 1 to 1024, found 0"},
           {"imitate a --limit-seconds nan", "--limit-seconds: expected a number above 0, found nan"},
           {"adapt a --switch-penalty 1", "--switch-penalty: expected a number up to 0, found 1"},
           {"adapt a --method dance", "--method: expected auto, plan, options, printed, found dance"},
           {"adapt a --method plan --options b",
            "--options: expected --method auto, options or printed, found plan"},
           {"adapt a --budget-samples 7 --method plan",
            "--budget-samples: expected --method auto, options or printed"},
           {"adapt a --method plan --selector beam",
            "--selector: expected --method auto, options or printed"},
           {"adapt a --method plan --switch-penalty -1",
            "--switch-penalty: expected --method auto, options or printed"},
           {"adapt a --method plan --rescue-reward 0.5",
            "--rescue-reward: expected --method auto, options or printed"},
           {"adapt a --method options --gains", "--gains: expected --method auto or plan, found options"},
           {"adapt a --gains --method printed", "--gains: expected --method auto or plan, found printed"},
           {"pretrain a --out b --method dance", "--method: expected options, printed, found dance"},
           {"pretrain a --out b --preset huge", "--preset: expected small, large, found huge"},
           {"adapt a --method printed",
            "train them with `mimicx pretrain --method printed DIR --out OPTIONS`"},
           {"info a --up w", "--up: expected x, y, z, -x, -y, -z, found w"},
           {"info a --smplx none.npz", "--smplx: expected an existing file, found none.npz"},
           {"info a --floor inf", "--floor: expected a number, found inf"},
           {"export-mjcf a.xml --betas 1,,6", "--betas: expected a number from -5 to 5, found 6"},
           {"export-mjcf a.xml --betas 1 --motion b", "--betas excludes --motion"},
           {"audit a --csv b", "--csv requires --poses"},
           {"synth --data-set a --clips 2", "--clips excludes --data-set"},
           {"synth --data-set a --kinds walk", "--kinds excludes --data-set"},
           {"synth --data-set a --noise none", "--noise excludes --data-set"},
           {"synth --data-set a --camera wild", "--camera excludes --data-set"},
           {"synth --data-set a --keypoints coco17", "--keypoints excludes --data-set"},
           {"synth --data-set a --seed 7", "--seed excludes --data-set"},
           {"synth --data-set a --report", "--report excludes --data-set"},
           {"plan a --out ''", "--out: expected a path, found nothing"},
           {"plan a --set gamma", "--set: expected NAME=NUMBER, found 'gamma'"},
           {"convert a ''", "OUT: expected a path, found nothing"},
           {"info ''", "FILE: expected a path, found nothing"},
           {"evaluate --truth a --motions ''", "--motions: expected a path, found nothing"},
           {"cluster a --out b.npz", "--out: expected a file that ends in .json, found b.npz"},
           {"cluster a --out b --clusters 0", "--clusters: expected a whole number from 1 on, found 0"},
           {"info", "FILE is required"},
           {"info a b", "unexpected argument: b"},
           {"info a --scale", "--scale: expected a value, found nothing"},
           {"plan a --out b --out c", "--out is given twice"},
           {"--frob", "unknown option --frob"},
           {"", "expected a command"}}) {
    const Call call = mimicx(arguments);
    EXPECT_EQ(call.status, 2) << arguments << '\n' << call.text;
    EXPECT_TRUE(says(call, said)) << arguments << '\n' << call.text;
    EXPECT_EQ(lines_of(call.text).size(), 1u) << call.text;
  }
}

TEST_F(Cli, ForcesRefuseOptionsOfReadingThatTheyDoNotUse) {
  motion::write_clip(path("walk.npz"), motion::standing_clip(10));
  const std::string forces = "evaluate --forces " + path("walk.mot") + " --motions " + path("walk.npz");
  const Call call = mimicx(forces + " --mass 70 --up y --scale 7 --height 1.8");
  EXPECT_EQ(call.status, 2) << call.text;
  EXPECT_TRUE(says(call, "up=y") && says(call, "scale=7") && says(call, "height=1.8")) << call.text;
  EXPECT_FALSE(says(call, "mass=70")) << call.text;
  EXPECT_EQ(lines_of(call.text).size(), 1u) << call.text;
  EXPECT_EQ(mimicx(forces + " --mass 70").status, 1) << "there is no walk.mot";
}

TEST_F(Cli, ClosedPipeFinishesTheWorkWithStatusOne) {
  motion::write_clip(path("a.npz"), motion::standing_clip(20));
  const std::string fit = std::string(MIMICX_BINARY) + " fit " + path("a.npz") + " --out " + path("out");
  const Call gone = shell("exec 4>&1; { sleep 0.2; " + fit + " 2>&4; echo status $? >&4; } | true");
  EXPECT_TRUE(says(gone, "status 1")) << gone.text;
  EXPECT_TRUE(says(gone, "standard output cannot be written to")) << gone.text;
  EXPECT_TRUE(std::filesystem::exists(path("out/a.npz")));
}

}  // namespace
}  // namespace mimicx::program
