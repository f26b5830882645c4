#include "core/file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/archives.h"
#include "core/error.h"
#include "core/temporary_folder.h"

namespace mimicx {
namespace {

TEST(WriteFile, ErrorStatesTheReasonAndLeavesNoFile) {
  const auto why = [](const fs::path& path) -> std::string {
    try {
      write_file_atomically(path, "content");
      return "written";
    } catch (const DataError& error) {
      return error.what();
    }
  };
  const fs::path folder = scratch("taken.npz");
  fs::create_directories(folder);
  EXPECT_EQ(why(folder), folder.string() + ": expected a writable file, found Is a directory");
  for (const auto& entry : fs::directory_iterator(folder.parent_path()))
    EXPECT_NE(entry.path().extension(), ".mimicx-tmp") << entry.path();
  const fs::path nowhere = scratch("nowhere") / "file";
  EXPECT_EQ(why(nowhere), nowhere.string() + ": expected a writable file, found No such file or directory");
}

TEST(IsWithin, HoldsInEverySpellingAndThroughLinks) {
  const TemporaryFolder temporary;
  const fs::path folder = temporary.path;
  fs::create_directories(folder / "run");
  fs::create_directory_symlink(folder / "run", folder / "link");
  const fs::path run = folder / "run";
  for (const char* inside : {"run", "run/", "run/new/file", "link", "link/new", "other/../run/a", "./run"})
    EXPECT_TRUE(is_within(folder / inside, run)) << inside;
  for (const char* outside : {"", "run-2", "runs/a", "run/../a", "link/../a", "new/run"})
    EXPECT_FALSE(is_within(folder / outside, run)) << outside;
  EXPECT_TRUE(is_within("none/a", fs::current_path() / "none/")) << "neither exists";
  EXPECT_FALSE(is_within(fs::current_path(), "none"));
}

TEST(WriteFile, TwoWritersOfOneFileDoNotMix) {
  const fs::path path = scratch("shared.csv");
  AtomicFile first(path), second(path);
  first.write("first,");
  second.write("second,");
  first.write("first");
  second.write("second");
  first.finish();
  EXPECT_EQ(read_file(path), "first,first");
  second.finish();
  EXPECT_EQ(read_file(path), "second,second");
}

TEST(WriteFile, TakesTheTemporaryFileOfAKilledProgram) {
  const fs::path folder = scratch("killed");
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "a.csv.mimicx-tmp") << "half of what was to be written";
  write_file_atomically(folder / "a.csv", "whole");
  EXPECT_EQ(read_file(folder / "a.csv"), "whole");
  EXPECT_FALSE(fs::exists(folder / "a.csv.mimicx-tmp"));
}

TEST(WriteFile, AnInterruptLeavesNoTemporaryFile) {
  const fs::path folder = scratch("interrupted");
  fs::remove_all(folder);
  fs::create_directories(folder);
  {
    AtomicFile file(folder / "a.csv");
    file.write("half");
    EXPECT_FALSE(fs::is_empty(folder));
    remove_unfinished_files();
    EXPECT_TRUE(fs::is_empty(folder));
  }
  write_file_atomically(folder / "b.csv", "whole");
  remove_unfinished_files();
  EXPECT_EQ(read_file(folder / "b.csv"), "whole") << "what is finished stays";
}

TEST(DataErrors, AreOneLineWhateverTheFileIsCalled) {
  EXPECT_STREQ(DataError("a\nb\r.npz", "line 1", "x", "y").what(), "a?b?.npz: line 1: expected x, found y");
}

TEST(Reason, OfTheStandardLibrarysErrorsIsInWords) {
  EXPECT_EQ(reason_of(std::bad_alloc()), "not enough memory");
  EXPECT_EQ(reason_of(std::runtime_error("why")), "why");
  EXPECT_EQ(reason_of(fs::filesystem_error("cannot", "a/b", make_error_code(std::errc::filename_too_long))),
            "a/b: File name too long");
}

TEST(ReadFile, ErrorStatesTheReason) {
  const auto why = [](const fs::path& path, std::uintmax_t most = kMaxFileBytes) -> std::string {
    try {
      return read_file(path, most);
    } catch (const DataError& error) {
      return error.what();
    }
  };
  const fs::path file = scratch("file"), folder = scratch("folder");
  std::ofstream(file) << "content";
  fs::create_directories(folder);
  EXPECT_EQ(why(file), "content");
  EXPECT_EQ(why(scratch("none")), scratch("none").string() + ": expected a readable file, found none");
  EXPECT_EQ(why(folder), folder.string() + ": expected a file, found a folder");
  EXPECT_EQ(why("/dev/zero"), "/dev/zero: expected a regular file, found something else");
  EXPECT_EQ(why(file, 3), file.string() + ": expected at most 3 bytes, found 7");
  fs::permissions(file, fs::perms::none);
  if (std::ifstream(file)) GTEST_SKIP() << "this user may read everything";
  EXPECT_EQ(why(file), file.string() + ": expected a readable file, found Permission denied");
}

}  // namespace
}  // namespace mimicx
