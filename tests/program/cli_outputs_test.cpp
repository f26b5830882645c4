// No command overwrites an input, or a file that it did not make.
#include <fstream>

#include "core/npz/npz.h"
#include "import/motion_file.h"
#include "program/cli.h"
#include "record/folder_lock.h"
#include "run/results.h"

namespace mimicx::program {
namespace {

/// One output of a command: how to ask for it at a place, and what it then is called.
struct Asked {
  const char* name;
  std::string arguments;  ///< with IN for the input and OUT for what is asked for
  std::string file;       ///< the file that would be written
};

struct CliOutputs : Cli {
  void SetUp() override {
    std::filesystem::create_directories(path("in"));
    motion::write_clip(path("in/w.npz"), motion::standing_clip(20));
    motion::write_clip(path("in/b.npz"), motion::standing_clip(30));
  }
  /// Every command that writes, with a place where the user has a file of the same name.
  std::vector<Asked> all() const {
    const std::string w = path("in/w.npz"), mine = path("mine");
    const std::string small = " --samples 1 --threads 1 --out " + mine, plan = " --threads 1 --out " + mine;
    const std::string certify = "certify " + path("stepped/motions/w.npz") + " --out " + mine;
    return {{"convert npz", "convert " + w + " " + mine + ".npz", "mine.npz"},
            {"convert npy", "convert " + w + " " + mine + ".npy", "mine.npy"},
            {"convert bvh", "convert " + w + " " + mine + ".bvh", "mine.bvh"},
            {"convert qpos", "convert " + w + " " + mine + ".qpos.npz", "mine.qpos.npz"},
            {"convert glb", "convert " + w + " " + mine + ".glb", "mine.glb"},
            {"convert csv", "convert " + w + " " + mine + ".csv", "mine.csv"},
            {"render", "render " + w + " --skin shapes --frames 1 --size 60x60 --out " + mine + ".png",
             "mine.png"},
            {"export-mjcf", "export-mjcf " + mine + ".xml", "mine.xml"},
            {"cluster", "cluster " + path("in") + " --clusters 1 --out " + mine + ".json", "mine.json"},
            {"evaluate",
             "evaluate --truth " + path("in") + " --motions " + path("in") + " --json " + mine + ".json",
             "mine.json"},
            {"evaluate two",
             "evaluate --truth " + path("in") + " --motions " + path("in") + " " + path("in") + " --json " +
                 mine + ".json",
             "mine.json"},
            {"evaluate protocol",
             "evaluate --protocol phc --truth " + path("in") + " --motions " + path("in") + " --json " +
                 mine + ".json",
             "mine.json"},
            {"audit --poses --json", "audit --poses " + w + " --json " + mine + ".json", "mine.json"},
            {"audit --csv", "audit --poses " + w + " --csv " + mine + ".csv", "mine.csv"},
            {"audit --frames-csv", "audit --poses " + w + " --frames-csv " + mine + ".csv", "mine.csv"},
            {"fit", "fit " + w + " --out " + mine, "mine/w.npz"},
            {"certify", certify, "mine/w.npz"},
            {"certify, certificate", certify, "mine/w.cert"},
            {"corrupt", "corrupt " + w + " --out " + mine, "mine/noisy/w.npz"},
            {"synth", "synth --kinds wave --out " + mine, "mine/truth/wave_1.npz"},
            {"imitate", "imitate " + w + small, "mine/training/w.csv"},
            {"plan", "plan " + w + plan, "mine/motions/w.npz"},
            {"plan, report", "plan " + w + plan, "mine/report.html"}};
  }
};

TEST_F(CliOutputs, ReplacesOwnFilesAndOthersOnlyByForce) {
  const Call stepped =
      mimicx("plan " + path("in/w.npz") + " --no-fit --substeps --threads 1 --out " + path("stepped"));
  ASSERT_EQ(stepped.status, 0) << stepped.text;
  for (const Asked& asked : all()) {
    const std::filesystem::path file = path(asked.file);
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << "years of work";
    const Call refused = mimicx(asked.arguments);
    EXPECT_EQ(refused.status, 2) << asked.name << ": " << refused.text;
    EXPECT_TRUE(says(refused, asked.file + " exists")) << asked.name << ": " << refused.text;
    EXPECT_EQ(read_file(file), "years of work") << asked.name;
    const Call forced = mimicx(asked.arguments + " --force");
    EXPECT_LE(forced.status, 1) << asked.name << ": " << forced.text;
    EXPECT_NE(read_file(file), "years of work") << asked.name;
    const Call again = mimicx(asked.arguments);
    EXPECT_EQ(again.status, forced.status) << asked.name << ": " << again.text;
    std::filesystem::remove_all(path("mine"));
    std::filesystem::remove(file);
  }
}

TEST_F(CliOutputs, NeverOverwritesAnInput) {
  const std::string w = path("in/w.npz"), b = path("in/b.npz"), in = path("in");
  std::filesystem::create_directories(path("k/motions"));
  motion::write_clip(path("k/motions/w.npz"), motion::standing_clip(20));
  import::write_motion(path("x.bvh"), motion::standing_clip(20));
  const std::string x = path("x.bvh"), k = path("k/motions/w.npz");
  const std::vector<std::string> files = {w, b, x, k};
  std::vector<std::string> before;
  for (const std::string& file : files) before.push_back(read_file(file));
  for (const std::string& arguments :
       {"convert " + x + " " + x, "convert " + w + " " + path("in/../in/w.npz"), "fit " + in + " --out " + in,
        "export-mjcf --motion " + w + " " + w, "cluster " + w + " " + b + " --clusters 1 --out " + w,
        "evaluate --truth " + in + " --motions " + in + " --json " + w, "audit --poses " + w + " --csv " + w,
        "audit " + w + " --json " + w, "plan " + k + " --out " + path("k"),
        "imitate " + k + " --samples 1 --out " + path("k")})
    for (const char* force : {"", " --force"}) {
      const Call call = mimicx(arguments + force);
      EXPECT_EQ(call.status, 2) << arguments << force << '\n' << call.text;
      EXPECT_TRUE(says(call, "is an input")) << arguments << '\n' << call.text;
      for (std::size_t i = 0; i < files.size(); ++i)
        ASSERT_EQ(read_file(files[i]), before[i]) << arguments << force;
    }
}

TEST_F(CliOutputs, CleanCopyNeverReplacesOtherFiles) {
  std::ofstream(path("in/w.clean.npz")) << "mine";
  const std::string command = "plan " + path("in/w.npz") + " --threads 1";
  const Call refused = mimicx(command);
  EXPECT_EQ(refused.status, 2) << refused.text;
  EXPECT_TRUE(says(refused, "w.clean.npz exists")) << refused.text;
  EXPECT_FALSE(std::filesystem::exists(path("in/w.mimicx"))) << "nothing is begun";
  EXPECT_EQ(read_file(path("in/w.clean.npz")), "mine");
  EXPECT_EQ(mimicx(command + " --force").status, 0);
  EXPECT_NO_THROW(motion::read_clip(path("in/w.clean.npz")));
  EXPECT_EQ(mimicx(command).status, 0) << "our own is replaced";
  // The copy is an input of the same command: the other input must not be cleaned onto it.
  EXPECT_EQ(mimicx(command + " " + path("in/w.clean.npz")).status, 2);
}

TEST_F(CliOutputs, ListsSkippedFiles) {
  std::ofstream(path("in/notes.md")) << "walks";
  std::filesystem::copy(path("in/w.npz"), path("in/w.clean.npz"));
  for (const std::string& command :
       {"cluster " + path("in") + " --clusters 1 --out " + path("c.json"), "audit --poses " + path("in"),
        "fit " + path("in") + " --out " + path("f"), "corrupt " + path("in") + " --out " + path("c"),
        "imitate " + path("in") + " --samples 1 --out " + path("i")}) {
    const Call call = mimicx(command);
    EXPECT_TRUE(says(call, path("in") + ": skipped: notes.md, w.clean.npz (no motions")) << call.text;
  }
}

TEST_F(CliOutputs, RemakesDamagedFilesOrReportsThem) {
  const std::string command = "imitate " + path("in/w.npz") + " --samples 1 --threads 1 --out " + path("run");
  const Call first = mimicx(command);
  const auto whole = run::results_of(path("run"));
  const std::string motion = whole.contains("motions/w.npz") ? "motions/w.npz" : "rejected/w.npz";
  const auto damage = [&](const std::string& file) {
    std::filesystem::resize_file(path("run/" + file), whole.at(file).size() / 2);
  };
  damage(motion);
  Call again = mimicx(command);
  EXPECT_EQ(again.status, first.status) << again.text;
  EXPECT_TRUE(says(again, motion + " is damaged: made again")) << again.text;
  EXPECT_EQ(run::results_of(path("run")), whole);

  std::filesystem::remove(path("run/references/w.npz"));
  again = mimicx(command);
  EXPECT_TRUE(says(again, "references/w.npz is gone or damaged: made again")) << again.text;
  EXPECT_EQ(run::results_of(path("run")), whole);

  std::filesystem::remove(path("run/training/w.csv"));
  again = mimicx(command);
  EXPECT_TRUE(says(again, "training/w.csv is gone or damaged, and is not made again")) << again.text;
}

TEST_F(CliOutputs, SpellingsOfOneFileAreOneInput) {
  const std::string w = path("in/w.npz"), other = path("in/../in/./w.npz");
  const std::string end = " --samples 1 --threads 1 --out " + path("run");
  const Call call = mimicx("imitate " + w + " " + other + " " + w + end);
  const auto whole = run::results_of(path("run"));
  EXPECT_FALSE(whole.contains("references/w-2.npz")) << call.text;
  mimicx("imitate " + other + end);
  EXPECT_EQ(run::results_of(path("run")), whole) << "the same input, spelled otherwise";
}

TEST_F(CliOutputs, NonUtf8NamesPassThroughAllRecords) {
  const std::string name = "w\xff\xe9";
  std::filesystem::copy(path("in/w.npz"), path("in/" + name + ".npz"));
  const std::string file = "'" + path("in/" + name + ".npz") + "'";
  const std::string command = "imitate " + file + " --samples 1 --threads 1 --out " + path("run");
  const Call call = mimicx(command);
  EXPECT_TRUE(std::filesystem::exists(path("run/references/" + name + ".npz"))) << call.text;
  EXPECT_TRUE(says(call, name)) << call.text;
  const auto whole = run::results_of(path("run"));
  EXPECT_EQ(mimicx(command).status, call.status);
  EXPECT_EQ(run::results_of(path("run")), whole) << "found again in the manifest";
  for (const std::string& other :
       {"cluster " + file + " --clusters 1 --out " + path("c.json"),
        "audit --poses " + file + " --json " + path("a.json") + " --csv " + path("a.csv"),
        "pretrain " + file + " --samples 1 --threads 1 --no-encoder --out " + path("options")}) {
    const Call made = mimicx(other);
    EXPECT_EQ(made.status, 0) << made.text;
    EXPECT_FALSE(says(made, "json")) << made.text;
  }
}

TEST_F(CliOutputs, RejectsASecondProcessOnOneFolder) {
  const record::FolderLock lock(path("run"));
  for (const std::string& command :
       {"imitate " + path("in/w.npz"), "plan " + path("in/w.npz"), "pretrain " + path("in/w.npz"),
        "fit " + path("in/w.npz"), "corrupt " + path("in/w.npz"), std::string("synth --kinds wave")}) {
    const Call call = mimicx(command + " --out " + path("run"));
    EXPECT_EQ(call.status, 2) << call.text;
    EXPECT_EQ(call.text, "mimicx: " + path("run") + ": another mimicx is writing to this folder\n");
  }
}

TEST_F(CliOutputs, FullDeviceOnStandardOutputIsStatusOne) {
  for (const char* command : {"config", "info IN", "audit --poses IN", "cluster IN --clusters 1 --out OUT"}) {
    const std::string arguments = replaced(replaced(command, "IN", path("in/w.npz")), "OUT", path("c.json"));
    const Call call = mimicx(arguments + " 2>&1 >/dev/full || exit $?");
    EXPECT_EQ(call.status, 1) << command;
    EXPECT_TRUE(says(call, "standard output cannot be written to")) << call.text;
  }
}

TEST_F(CliOutputs, RejectsAPipeAsMotionWithoutWaiting) {
  ASSERT_EQ(shell("mkfifo " + path("in/pipe.npz")).status, 0);
  const Call call = shell("timeout 20 " + std::string(MIMICX_BINARY) + " plan " + path("in/pipe.npz") +
                          " --out " + path("run") + " 2>&1");
  EXPECT_EQ(call.status, 1) << call.text;
  EXPECT_TRUE(says(call, "pipe.npz: expected a regular file")) << call.text;
}

TEST_F(CliOutputs, OutputToAClosedStreamGoesIntoNoFile) {
  for (const char* closed : {"1>&- 2>&-", "0<&- 1>&- 2>&-"}) {
    const std::string out = path(std::string("run_") + closed[0]);
    const Call call = shell(std::string(MIMICX_BINARY) + " plan " + path("in/w.npz") + " --shard 0/1 --out " +
                            out + " " + closed);
    EXPECT_EQ(call.status, 0) << closed;
    for (const char* lock : {"/shards/lock", "/shards/000-of-001/lock"})
      EXPECT_EQ(read_file(out + lock), "") << closed << lock;
  }
}

TEST_F(CliOutputs, EscapesControlCharactersOfFileNames) {
  const Call call = mimicx("info \"$(printf 'a\\033[31m\\177.npz')\"");
  EXPECT_EQ(call.status, 1);
  EXPECT_EQ(call.text, "mimicx: a\\x1b[31m\\x7f.npz: expected a readable file, found none\n");
}

TEST_F(CliOutputs, ResamplesMembersPerFrameAndCopiesTheOthers) {
  motion::Clip clip = foreign_clip(60.0);  // 40 frames, hands
  clip.passthrough.emplace_back("dmpls", from_matrix(Eigen::MatrixXd::Random(40, 8)));
  clip.passthrough.emplace_back("num_betas", NpyArray::scalar_int(16));
  motion::write_clip(path("f.npz"), clip);
  const Call call = mimicx("imitate " + path("f.npz") + " --samples 1 --threads 1 --out " + path("run"));
  const bool ok = std::filesystem::exists(path("run/motions/f.npz"));
  const Npz out = read_npz(path(ok ? "run/motions/f.npz" : "run/rejected/f.npz"));
  const std::size_t frames = out.at("trans").shape[0];
  EXPECT_EQ(frames, 20u) << call.text;
  EXPECT_EQ(out.at("pose_hand").shape, (std::vector<std::size_t>{frames, 90}));
  EXPECT_EQ(out.at("poses").shape, (std::vector<std::size_t>{frames, 165}));
  EXPECT_EQ(out.at("dmpls").shape, (std::vector<std::size_t>{frames, 8}));
  EXPECT_EQ(out.at("num_betas").to_double(), std::vector<double>{16.0});
  EXPECT_EQ(to_matrix(out.at("dmpls")).row(7), to_matrix(read_npz(path("f.npz")).at("dmpls")).row(14));
}

}  // namespace
}  // namespace mimicx::program
