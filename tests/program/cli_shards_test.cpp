// Several machines, one run: parts in any order, and what `mimicx merge` makes of them.
#include <sstream>

#include "core/file.h"
#include "import/bvh_write.h"
#include "motion/clip_file.h"
#include "program/cli.h"
#include "record/folder_lock.h"
#include "record/json.h"
#include "record/shard.h"
#include "run/results.h"

namespace mimicx::program {
namespace {

/// Three motions that succeed, two of one file name and one of another format; one that nobody can follow;
/// and one that cannot be read.
struct CliShards : Cli {
  void SetUp() override {
    for (const char* in : {"in/1", "in/2"}) std::filesystem::create_directories(path(in));
    motion::write_clip(path("in/1/a.npz"), motion::standing_clip(12));
    motion::write_clip(path("in/2/a.npz"), motion::standing_clip(15));
    import::write_bvh(path("in/b.bvh"), motion::standing_clip(12));
    write_file_atomically(path("in/none.npz"), "no motion");
  }
  /// `mimicx plan` of all, in `out`.
  std::string plan(const std::string& out, const std::string& more = {}) const {
    std::string line = "plan --floor 0 --as-is --threads 1 ";
    for (const char* file : {"1/a.npz", "2/a.npz", "b.bvh", "none.npz"})
      line.append(path("in")).append("/").append(file).append(" ");
    return line.append("--out ").append(path(out)).append(" ").append(more);
  }
  std::string shard(const std::string& out, int index, int count, const std::string& more = {}) const {
    std::ostringstream part;
    part << "--shard " << index << '/' << count << ' ' << more;
    return plan(out, part.str());
  }
  /// Bytes of all that the whole run has, too.
  std::map<std::string, std::string> merged(const std::string& out) const {
    auto files = run::results_of(path(out));
    std::erase_if(files, [](const auto& file) { return file.first.starts_with("shards/"); });
    return files;
  }
};

TEST_F(CliShards, MergeIntoTheBytesOfTheUnshardedRun) {
  ASSERT_EQ(mimicx(plan("whole")).status, 1);  // one of them cannot be done
  const auto whole = run::results_of(path("whole"));
  ASSERT_TRUE(whole.contains("motions/a-2.npz") && whole.contains("clean/b.bvh") &&
              whole.contains("report.html"));
  for (const int count : {1, 5}) {  // 2: KilledShardContinuesToTheSameBytes
    const std::string out = std::string("in").append(std::to_string(count));
    for (int i = count - 1; i >= 0; --i) {
      const Call call = mimicx(shard(out, i, count));
      EXPECT_LE(call.status, 1) << call.text;
      EXPECT_FALSE(std::filesystem::exists(path(out + "/manifest.json")));
    }
    const Call merge = mimicx("merge " + path(out));
    EXPECT_EQ(merge.status, 0) << merge.text;
    const std::string shards = std::to_string(count).append(" shards");
    EXPECT_TRUE(says(merge, "4 motions of ") && says(merge, shards + ", 3 ok, 1 failed")) << merge.text;
    EXPECT_EQ(merged(out), whole) << count;
    const auto times = record::Json::parse(read_file(path(out + "/timing.json"))).at("sequences");
    EXPECT_EQ(times.elements().size(), 4u);
    EXPECT_EQ(times.at(1).at("name").get<std::string>(), "a-2");
  }
  EXPECT_EQ(mimicx(plan("in5")).status, 1) << "the merged run goes on as one that was never in parts";
  EXPECT_EQ(merged("in5"), whole);
  EXPECT_EQ(mimicx("merge " + path("in5")).status, 0) << "and may be merged again";
  EXPECT_EQ(merged("in5"), whole);
}

TEST_F(CliShards, KilledShardContinuesToTheSameBytes) {
  motion::write_clip(path("in/2/a.npz"),
                     motion::standing_clip(90));  // long after the first of its part is done
  ASSERT_EQ(mimicx(plan("whole")).status, 1);
  const std::string journal = path("parts/shards/001-of-002/journal.jsonl");
  mimicx(shard("parts", 1, 2) + " 2>&1 & while [ ! -s " + journal +
         " ] && kill -0 $! 2>/dev/null; do sleep 0.005; done; kill -9 $!; wait $!");
  ASSERT_TRUE(std::filesystem::exists(journal)) << "it was killed in its middle";
  EXPECT_LE(mimicx(shard("parts", 0, 2)).status, 1);
  const Call early = mimicx("merge " + path("parts"));
  EXPECT_EQ(early.status, 1) << early.text;
  EXPECT_TRUE(says(early, "are missing, in shards 1 of 2")) << early.text;
  EXPECT_TRUE(says(early, "--shard 1/2")) << early.text;
  EXPECT_FALSE(std::filesystem::exists(path("parts/manifest.json")))
      << "nothing is written before all is there";
  EXPECT_LE(mimicx(shard("parts", 1, 2)).status, 1);
  EXPECT_EQ(mimicx("merge " + path("parts")).status, 0);
  EXPECT_EQ(merged("parts"), run::results_of(path("whole")));
}

TEST_F(CliShards, MergeListsMissingShardsForSbatchAndFiles) {
  mimicx(shard("parts", 0, 4));
  const Call missing = mimicx("merge --missing " + path("parts"));
  EXPECT_EQ(missing.status, 1);
  const std::vector<std::string> lines = lines_of(missing.text);
  ASSERT_EQ(lines.size(), 4u) << missing.text;
  EXPECT_EQ(lines[0], "--array=1-3");
  for (std::size_t i = 1; i < 4; ++i) EXPECT_TRUE(std::filesystem::exists(lines[i])) << lines[i];
  const auto json = record::Json::parse(mimicx("merge --missing --json " + path("parts")).text);
  EXPECT_EQ(json.at("missing").elements().size(), 3u);
  EXPECT_EQ(json.at("missing_array").get<std::string>(), "1-3");
  mimicx(shard("parts", 2, 4));
  EXPECT_TRUE(says(mimicx("merge --missing " + path("parts")), "--array=1,3\n"));
  for (const int i : {1, 3}) mimicx(shard("parts", i, 4));
  const Call none = mimicx("merge --missing " + path("parts"));
  EXPECT_EQ(none.status, 0);
  EXPECT_EQ(none.text, "");
}

TEST_F(CliShards, DeletedMotionIsMissingAndRemade) {
  for (const int i : {0, 1}) mimicx(shard("parts", i, 2));
  ASSERT_EQ(mimicx("merge " + path("parts")).status, 0);
  const auto before = merged("parts");
  std::filesystem::remove(path("parts/motions/a-2.npz"));
  const Call missing = mimicx("merge --missing " + path("parts"));
  EXPECT_TRUE(says(missing, "in/2/a.npz\n")) << missing.text;
  for (const int i : {0, 1}) mimicx(shard("parts", i, 2));
  EXPECT_EQ(mimicx("merge " + path("parts")).status, 0);
  EXPECT_EQ(merged("parts"), before);
}

TEST_F(CliShards, RejectOtherCountsInputsAndSettingsInOneLine) {
  mimicx(shard("parts", 0, 2));
  for (const auto& [line, said] : std::vector<std::pair<std::string, std::string>>{
           {shard("parts", 0, 3), "holds a run in 2 shards, not in 3"},
           {shard("parts", 1, 2, "--set plan_horizon=7"), "(plan_horizon is "},
           {"plan " + path("in/b.bvh") + " --floor 0 --as-is --shard 1/2 --out " + path("parts"),
            "motion 1 of 4 is " + path("in/1/a.npz") + " there, " + path("in/b.bvh") + " here"},
           {plan("parts"), "`mimicx merge " + path("parts") + "` joins them"},
           {plan("parts", "--shard 2"), "--shard: expected I/N with I from 0 to N - 1, found 2"},
           {"plan " + path("in/b.bvh") + " --shard 0/2", "--shard: needs --out"}}) {
    const Call call = mimicx(line);
    EXPECT_EQ(call.status, 2) << line;
    EXPECT_TRUE(says(call, said)) << call.text;
    EXPECT_EQ(lines_of(call.text).size(), 1u) << call.text;
  }
  EXPECT_FALSE(std::filesystem::exists(path("parts/shards/000-of-003")))
      << "nothing is left of what was refused";
  ASSERT_EQ(mimicx("plan " + path("in/b.bvh") + " --threads 1 --out " + path("whole")).status, 0);
  const Call whole = mimicx("plan " + path("in/b.bvh") + " --shard 0/2 --out " + path("whole"));
  EXPECT_EQ(whole.status, 2);
  EXPECT_TRUE(says(whole, "holds a run that is not in shards")) << whole.text;
  const Call nothing = mimicx("merge " + path("in"));
  EXPECT_EQ(nothing.status, 1);
  EXPECT_TRUE(says(nothing, path("in") + ": expected a run in parts (--shard I/N), found none"))
      << nothing.text;
}

TEST_F(CliShards, DifferentBudgetsAreNotMerged) {
  const std::string command = "imitate " + path("in/b.bvh") + " " + path("in/1/a.npz") +
                              " --limit-seconds 1e-3 --threads 1 --set characters=64 --out " + path("parts");
  mimicx(command + " --shard 0/2 --samples 512");
  mimicx(command + " --shard 1/2 --samples 1024");
  const Call merge = mimicx("merge " + path("parts"));
  EXPECT_EQ(merge.status, 2);
  EXPECT_TRUE(says(merge, "(samples is 1024 there, 512 here)")) << merge.text;
}

TEST_F(CliShards, AreNotMergedWhileOneIsRunning) {
  for (const int i : {0, 1}) mimicx(shard("parts", i, 2));
  const record::RunFolder part = record::shard_folder(path("parts"), {1, 2});
  const record::FolderLock at_work(part.records, record::Hold::kAlone, "lock");
  for (const std::string& line :
       {"merge " + path("parts"), "merge --missing " + path("parts"), shard("parts", 1, 2)}) {
    const Call call = mimicx(line);
    EXPECT_EQ(call.status, 2);
    EXPECT_EQ(call.text, "mimicx: " + part.records.string() + ": another mimicx is writing to this folder\n");
  }
  EXPECT_LE(mimicx(shard("parts", 0, 2)).status, 1) << "the other one may go on beside it";
}

TEST_F(CliShards, ArrayTaskTakesItsShardByDefault) {
  const auto as_task = [&](const std::string& variables, const std::string& line) {
    return shell(variables + " " + MIMICX_BINARY + " " + line + " 2>&1");
  };
  const std::string task =
      "SLURM_ARRAY_TASK_ID=2 SLURM_ARRAY_TASK_COUNT=2 SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_MAX=2";
  const Call second = as_task(task, plan("parts"));
  EXPECT_TRUE(says(second, "shard 1/2: 2 of 4 motions")) << second.text;
  EXPECT_TRUE(std::filesystem::exists(path("parts/shards/001-of-002/manifest.json")));
  const Call whole = as_task(task, plan("whole", "--shard whole"));
  EXPECT_TRUE(std::filesystem::exists(path("whole/manifest.json"))) << whole.text;
  const Call again = as_task(
      "SLURM_ARRAY_TASK_ID=5 SLURM_ARRAY_TASK_COUNT=2 SLURM_ARRAY_TASK_MIN=3 "
      "SLURM_ARRAY_TASK_MAX=5",
      plan("parts"));
  EXPECT_EQ(again.status, 2);
  EXPECT_TRUE(says(again, "pass --shard I/N")) << again.text;
  EXPECT_EQ(lines_of(again.text).size(), 1u) << again.text;
  EXPECT_EQ(as_task(task, "plan " + path("in/b.bvh") + " --threads 1").status, 0)
      << "without --out every motion is a run of its own";
  EXPECT_TRUE(std::filesystem::exists(path("in/b.clean.bvh")));
}

TEST_F(CliShards, JobScriptReadsTheShardCountFromAStartedRun) {
  const auto task = [&](const std::string& id, const std::string& count, const std::string& first,
                        const std::string& last) {
    std::ostringstream line;
    line << "SLURM_ARRAY_TASK_ID=" << id << " SLURM_ARRAY_TASK_COUNT=" << count
         << " SLURM_ARRAY_TASK_MIN=" << first << " SLURM_ARRAY_TASK_MAX=" << last
         << " MIMICX=" << MIMICX_BINARY << " bash " << MIMICX_SOURCE_DIR << "/tools/slurm/mimicx.sbatch plan "
         << path("in") << ' ' << path("parts") << " --floor 0 --as-is 2>&1";
    return shell(line.str());
  };
  const Call part = task("1", "2", "1", "3");
  EXPECT_EQ(part.status, 2);
  EXPECT_TRUE(says(part, "expected a first submission of all shards, --array=0-N")) << part.text;
  EXPECT_TRUE(says(task("0", "4", "0", "3"), "shard 0/4: 1 of 4 motions"));
  EXPECT_TRUE(says(task("1", "2", "1", "3"), "shard 1/4: 1 of 4 motions")) << "--array=1,3";
  EXPECT_TRUE(says(task("1", "2", "0", "1"), "shard 1/4: ")) << "--array=0-1 is no first submission here";
  EXPECT_EQ(lines_of(mimicx("merge --missing " + path("parts")).text).at(0), "--array=2-3");
}

}  // namespace
}  // namespace mimicx::program
