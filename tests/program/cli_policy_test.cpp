// `mimicx export-policy`: what it finds, what it refuses, what it leaves alone.
#include <fstream>

#include "files/policy_file.h"
#include "program/cli.h"
#include "record/outputs.h"

namespace mimicx::program {
namespace {

struct CliPolicy : Cli {
  void SetUp() override {
    const motion::Clip clip = motion::standing_clip(20);
    files::StoredPolicy policy;
    motion::Reference body;
    body.name = clip.name;
    body.character = motion::character_of(clip);
    for (int t = 0; t < clip.frames(); ++t) {
      physics::State<double> state{};
      state.p_root.z = 0.9;
      for (auto& q : state.q) q.w = 1.0;
      policy.states.push_back(state);
    }
    policy.motion = rl::tracking::reference_of_states(body, policy.states);
    rl::AgentShape shape;
    shape.observation_dim = rl::tracking::kStateSize;
    shape.action_dim = kDofs;
    shape.hidden = {16};
    policy.agent = rl::make_agent(shape, 4);
    for (const char* name : {"run/policies/walk.npz", "run/policies/more/walk.npz"}) {
      std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
      files::write_policy(path(name), clip, policy);
    }
    std::filesystem::create_directories(path("options"));
    std::ofstream(path("options/options.npz")) << "no matter";
    std::filesystem::create_directories(path("plain"));
    std::ofstream(path("plain/manifest.json")) << "{}";
    std::filesystem::create_directories(path("empty"));
  }
};

TEST_F(CliPolicy, WritesEveryKindDeterministically) {
  for (const std::string out : {"a.h", "a.onnx", "a.npz", "new/folder/b.h"})
    for (const std::string more : {"", " --int8"}) {
      const std::string line = "export-policy " + path("run/walk") + " --out " + path(out) + more;
      const Call call = mimicx(line);
      EXPECT_EQ(call.status, 0) << line << '\n' << call.text;
      const std::string once = read_file(path(out));
      EXPECT_EQ(mimicx(line).status, 0) << line;
      EXPECT_EQ(read_file(path(out)), once) << line;
    }
}

TEST_F(CliPolicy, FindsAPolicyByNameByFolderAndByFile) {
  for (const std::string name : {"run/walk", "run/more/walk", "run/policies/walk.npz"})
    EXPECT_EQ(mimicx("export-policy " + path(name) + " --out " + path("x.h")).status, 0) << name;
}

TEST_F(CliPolicy, UnderstandsOtherFilesOfTheMotion) {
  write_file_atomically(path("run/manifest.json"), "{}");
  std::filesystem::create_directories(path("run/motions/more"));
  for (const std::string name : {"walk", "more/walk", "jog"})
    motion::write_clip(path("run/motions/" + name + ".npz"), motion::standing_clip(20));
  for (const std::string name : {"walk", "more/walk"}) {
    EXPECT_EQ(mimicx("export-policy " + path("run/" + name) + " --out " + path("x.h")).status, 0) << name;
    const Call call =
        mimicx("export-policy " + path("run/motions/" + name + ".npz") + " --out " + path("y.h"));
    EXPECT_EQ(call.status, 0) << call.text;
    EXPECT_EQ(read_file(path("x.h")), read_file(path("y.h"))) << name;
  }
  const Call none = mimicx("export-policy " + path("run/motions/jog.npz") + " --out " + path("z.h"));
  EXPECT_EQ(none.status, 2);
  EXPECT_TRUE(says(none, "has no policy jog")) << none.text;
}

// tools/demo makes such a run.
TEST_F(CliPolicy, TakesAPolicyOfARunInTheFolderOfAnother) {
  write_file_atomically(path("run/manifest.json"), "{}");
  write_file_atomically(path("manifest.json"), "{}");
  for (const std::string name : {"run/policies/walk.npz", "run/policies/more/walk.npz"}) {
    const Call call = mimicx("export-policy " + path(name) + " --out " + path("x.h"));
    EXPECT_EQ(call.status, 0) << call.text;
  }
}

TEST_F(CliPolicy, WritesSeveralIntoOneHeaderAlone) {
  std::filesystem::copy_file(path("run/policies/walk.npz"), path("run/policies/stroll.npz"));
  const std::string both = "export-policy " + path("run/walk") + " " + path("run/stroll");
  EXPECT_EQ(mimicx(both + " --out " + path("all.h")).status, 0);
  const std::string header = read_file(path("all.h"));
  for (const char* space : {"namespace policies {", "namespace policy_walk {", "namespace policy_stroll {"})
    EXPECT_NE(header.find(space), std::string::npos) << space;
  EXPECT_EQ(mimicx(both + " --out " + path("all.onnx")).status, 2);
  const Call same =
      mimicx("export-policy " + path("run/walk") + " " + path("run/more/walk") + " --out " + path("same.h"));
  EXPECT_EQ(same.status, 2);
  EXPECT_TRUE(says(same, "namespace policy_walk")) << same.text;
}

TEST_F(CliPolicy, WritesOptionsOfASetForTheBodyOfAMotion) {
  const std::string trained = std::string(MIMICX_SOURCE_DIR) + "/data/options",
                    one = trained + "/option3 " + trained + "/taught/option7 --out ";
  EXPECT_EQ(mimicx("export-policy " + one + path("two.h")).status, 0);
  const std::string header = read_file(path("two.h"));
  for (const char* part : {"namespace policy_option3 {", "CodedPolicy<float> kPolicy",
                           "namespace policy_option7 {", "constexpr Policy<float> kPolicy"})
    EXPECT_NE(header.find(part), std::string::npos) << part;
  EXPECT_EQ(mimicx("export-policy taught/option7 --out " + path("seven.onnx")).status, 0);
  EXPECT_EQ(mimicx("export-policy taught --out " + path("all.h")).status, 0);
  EXPECT_NE(read_file(path("all.h")).find("namespace policy_option9 {"), std::string::npos);
  motion::Clip tall = motion::standing_clip(20);
  tall.betas[0] = 2.0;
  motion::write_clip(path("tall.npz"), tall);
  EXPECT_EQ(mimicx("export-policy " + one + path("tall.h") + " --body " + path("tall.npz")).status, 0);
  EXPECT_NE(read_file(path("tall.h")).find("kShape[10] = {\n 2.0F,"), std::string::npos);
}

TEST_F(CliPolicy, NamesWhatIsMissingInOneLine) {
  const std::pair<std::string, std::string> cases[] = {
      {path("run/jog") + " --out " + path("x.h"), "run has no policy jog: it has more/walk, walk"},
      {path("options/walk") + " --out " + path("x.h"), "it has options, which follow many motions"},
      {"trained/walk --out " + path("x.h"), "it has options, which follow many motions: trained/option0"},
      {"trained/option6 --out " + path("x.h"), "has the options 0 to 5, no option6"},
      {"trained/option0 --out " + path("x.onnx"), "x.onnx: an option with an encoder is written as a header"},
      {"trained/option0 --int8 --out " + path("x.h"), "--int8: rounding suits the weights to a motion"},
      {path("run/walk") + " --body " + path("run/policies/walk.npz") + " --out " + path("x.h"),
       "--body: a policy of a motion is for the body of that motion"},
      {path("plain/walk") + " --out " + path("x.h"), "it has no policies"},
      {path("empty/walk") + " --out " + path("x.h"), "it is no folder of `mimicx adapt --out`"},
      {path("none/walk") + " --out " + path("x.h"), "none is no folder: expected a policy as RUN/NAME"},
      {path("run/walk") + " --out " + path("x.hpp"), "x.hpp: expected a file that ends in .h, .onnx or .npz"},
      {path("run/walk"), "--out is required"},
      {path("run/policies/walk.npz") + " --out " + path("run/policies/walk.npz"), "is an input"}};
  for (const auto& [arguments, words] : cases) {
    const Call call = mimicx("export-policy " + arguments);
    EXPECT_EQ(call.status, 2) << arguments << '\n' << call.text;
    EXPECT_TRUE(says(call, words)) << arguments << '\n' << call.text;
    EXPECT_EQ(lines_of(call.text).size(), 1U) << arguments << '\n' << call.text;
    EXPECT_FALSE(std::filesystem::exists(path("x.h")));
  }
}

TEST_F(CliPolicy, ReplacesOwnFilesAndOthersOnlyByForce) {
  for (const std::string out : {"mine.h", "mine.onnx", "mine.npz"}) {
    std::ofstream(path(out)) << "years of work";
    const std::string line = "export-policy " + path("run/walk") + " --out " + path(out);
    const Call refused = mimicx(line);
    EXPECT_EQ(refused.status, 2) << refused.text;
    EXPECT_TRUE(says(refused, out + " exists")) << refused.text;
    EXPECT_EQ(read_file(path(out)), "years of work");
    EXPECT_EQ(mimicx(line + " --force").status, 0);
    EXPECT_EQ(mimicx(line + " --int8").status, 0) << "our own is replaced";
  }
}

TEST_F(CliPolicy, RejectsAFileWithoutAPolicy) {
  motion::write_clip(path("run/policies/clip.npz"), motion::standing_clip(20));
  const Call call = mimicx("export-policy " + path("run/clip") + " --out " + path("x.h"));
  EXPECT_EQ(call.status, 1) << call.text;
  EXPECT_TRUE(says(call, "clip.npz")) << call.text;
  EXPECT_EQ(lines_of(call.text).size(), 1U) << call.text;
}

}  // namespace
}  // namespace mimicx::program
