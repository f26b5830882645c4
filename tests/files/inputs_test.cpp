#include "files/inputs.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/error.h"
#include "core/temporary_folder.h"
#include "record/outputs.h"

namespace mimicx::files {
namespace {

struct FindMotions : testing::Test {
  std::string path(const std::string& name) const { return (folder.path / name).string(); }
  void touch(const std::string& name, const std::string& text = "x") const {
    std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
    std::ofstream(path(name)) << text;
  }
  /// "name" of every motion found in `in`.
  std::vector<std::string> names(const std::string& out = {}) const {
    std::vector<std::string> found;
    for (const MotionInput& input : find_motions({path("in")}, out)) found.push_back(input.name);
    return found;
  }
  TemporaryFolder folder;
};

TEST_F(FindMotions, SearchesSubfoldersSortedByPathAndNamesByRelativePath) {
  for (const char* file : {"in/b.npz", "in/CMU/01/01_02_poses.npz", "in/CMU/01/01_01_poses.npz", "in/a.bvh"})
    touch(file);
  EXPECT_EQ(names(), (std::vector<std::string>{"CMU/01/01_01_poses", "CMU/01/01_02_poses", "a", "b"}));
  EXPECT_EQ(find_motions({path("in")})[0].path, path("in/CMU/01/01_01_poses.npz"));
  EXPECT_EQ(find_motions({path("in/CMU/01/01_02_poses.npz")})[0].name, "01_02_poses");
}

TEST_F(FindMotions, SkipsAndListsOtherFilesAndRunOutputs) {
  for (const char* file :
       {"in/a.npz", "in/a.clean.npz", "in/a.mimicx/motions/a.npz", "in/sub/shape.npz", "in/sub/notes.md",
        "in/sub/neutral_stagei.npz", "in/out/motions/a.npz", "in/fitted/a.npz"})
    touch(file);
  touch("in/out/manifest.json", "{\n \"run\": {}}");
  touch("in/sub/manifest.json", "{}");
  std::ostringstream messages;
  const auto found = find_motions({path("in")}, path("in/./fitted"), &messages);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "a");
  EXPECT_EQ(messages.str(), path("in") +
                                ": skipped: a.clean.npz, a.mimicx/, fitted/, out/, sub/manifest.json, "
                                "sub/neutral_stagei.npz, sub/notes.md, sub/shape.npz (no motions, made by an "
                                "earlier run, or read under another name)\n");
}

TEST_F(FindMotions, ALineBreakInANameBreaksNoMessage) {
  touch("in/a.npz");
  touch("in/x\ny.txt");
  std::ostringstream messages;
  find_motions({path("in")}, {}, &messages);
  EXPECT_NE(messages.str().find("skipped: x?y.txt (no"), std::string::npos) << messages.str();
}

TEST_F(FindMotions, CountsManySkippedFiles) {
  touch("in/a.npz");
  for (int k = 100; k < 130; ++k) touch("in/" + std::to_string(k) + ".txt");
  std::ostringstream messages;
  find_motions({path("in")}, {}, &messages);
  EXPECT_NE(messages.str().find("106.txt, 107.txt and 22 more (no"), std::string::npos) << messages.str();
}

TEST_F(FindMotions, FollowsEachLinkOnce) {
  touch("in/sub/a.npz");
  touch("elsewhere/b.npz");
  std::filesystem::create_directory_symlink(path("in"), path("in/sub/back"));
  std::filesystem::create_directory_symlink(path("elsewhere"), path("in/link"));
  EXPECT_EQ(names(), (std::vector<std::string>{"link/b", "sub/a"}));
}

TEST_F(FindMotions, NamesMotionsByTheirFolderAndNotByALinkToIt) {
  touch("in/real/a.npz");
  for (const char* link : {"in/a_link", "in/z_link"})
    std::filesystem::create_directory_symlink(path("in/real"), path(link));
  EXPECT_EQ(names(), std::vector<std::string>{"real/a"});
}

TEST_F(FindMotions, UpFromALinkIsWhereItLeads) {
  touch("real/a.npz");
  touch("here/a.npz");
  std::filesystem::create_directories(path("real/sub"));
  std::filesystem::create_directory_symlink(path("real/sub"), path("here/link"));
  const auto found = find_motions({path("here/link/../a.npz")});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(std::filesystem::equivalent(found[0].path, path("real/a.npz"))) << found[0].path;
}

TEST_F(FindMotions, SaysWhichNamesAreLinksToAFileThatIsRead) {
  touch("in/a.npz");
  touch("in/sub/c.npz");
  std::filesystem::create_symlink(path("in/a.npz"), path("in/b.npz"));
  std::filesystem::create_directory_symlink(path("in"), path("in/sub/back"));
  std::ostringstream messages;
  EXPECT_EQ(find_motions({path("in")}, {}, &messages).size(), 2u);
  EXPECT_EQ(messages.str(), path("in") +
                                ": skipped: b.npz is a.npz, sub/back/ is . (no motions, made by an earlier "
                                "run, or read under another name)\n");
  messages.str("");
  EXPECT_EQ(find_motions({path("in/b.npz"), path("in/a.npz"), path("in/b.npz")}, {}, &messages).size(), 1u);
  EXPECT_EQ(messages.str(), path("in/a.npz") + ": skipped: it is " + path("in/b.npz") + "\n");
}

TEST_F(FindMotions, ListsAFileOnce) {
  touch("in/a.npz");
  EXPECT_EQ(find_motions({path("in"), path("in/a.npz"), path("in/../in/a.npz")}).size(), 1u);
}

TEST_F(FindMotions, ReadsTextFilesThatHoldABvh) {
  touch("in/walk.txt", "\n# saved by hand\nhierarchy\nROOT Hips\n");
  touch("in/readme.txt", "once upon a time");
  EXPECT_EQ(names(), std::vector<std::string>{"walk"});
}

TEST_F(FindMotions, APathDoesNotDependOnHowItIsTyped) {
  touch("in/a.npz");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path);
  for (const std::string& typed :
       {std::string("in/a.npz"), std::string("./in//a.npz"), std::string("in/../in/a.npz"),
        (std::filesystem::current_path() / "in/a.npz").string()}) {
    const auto found = find_motions({typed});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].path, "in/a.npz") << typed;
  }
  for (const std::string typed : {"in", "in/", "./in"})
    EXPECT_EQ(find_motions({typed})[0].path, "in/a.npz") << typed;
  EXPECT_EQ(find_motions({"nothere/"})[0].path, "nothere");
  std::filesystem::current_path(before);
}

TEST_F(FindMotions, RejectsFoldersWithoutMotionsAndPointsIntoRuns) {
  touch("in/notes.md");
  touch("run/manifest.json", "{\n \"run\": {}}");
  touch("run/motions/a.npz");
  const auto complaint = [&](const std::string& name) {
    try {
      find_motions({path(name)});
    } catch (const DataError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(complaint("in"), path("in") + ": expected motion files in this folder, found none");
  EXPECT_EQ(complaint("run"), path("run") +
                                  ": expected motion files in this folder, found a run: its motions are in "
                                  "motions/");
}

TEST_F(FindMotions, RefusesResultsInAFolderOfInputs) {
  touch("in/a.bvh");
  touch("in/truth/b.bvh");
  const auto refused = [&](const std::string& input, const std::string& out, const std::string& result) {
    try {
      require_results_apart({path(input)}, path(out), {path(out + "/" + result)});
    } catch (const record::OutputRefused&) {
      return true;
    }
    return false;
  };
  EXPECT_TRUE(refused("in", "in", "a.npz"));
  EXPECT_TRUE(refused("in", "in/.", "truth/a.npz"));
  EXPECT_TRUE(refused("in/truth", "in", "truth/b.npz"));
  EXPECT_FALSE(refused("in/truth", "in", "b.npz")) << "above its inputs";
  EXPECT_FALSE(refused("in", "in/out", "a.npz")) << "which is skipped";
  EXPECT_FALSE(refused("in", "in-2", "a.npz"));
  EXPECT_FALSE(refused("in/a.bvh", "in", "a.npz")) << "no folder is read";
}

}  // namespace
}  // namespace mimicx::files
