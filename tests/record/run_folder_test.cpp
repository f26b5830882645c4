#include "record/run_folder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "core/temporary_folder.h"

namespace mimicx::record {
namespace {

TEST(RunFolder, EqualFileNamesGetUniqueNames) {
  EXPECT_EQ(unique_name("walk", {}), "walk");
  EXPECT_EQ(unique_name("walk", {"walk"}), "walk-2");
  EXPECT_EQ(unique_name("walk", {"walk", "walk-2"}), "walk-3");
}

TEST(RunFolder, PartsOfAMotionHaveNoOtherMotionsName) {
  std::set<std::string> taken;
  EXPECT_EQ(unique_motion_name("walk", taken), "walk");
  EXPECT_EQ(unique_motion_name("walk.part1", taken), "walk.part1-2");
  EXPECT_EQ(unique_motion_name("run.part2", taken), "run.part2");
  EXPECT_EQ(unique_motion_name("run", taken), "run-2") << "its second part would be run.part2";
  EXPECT_TRUE(RunFolder::is_part_name("walk.part9"));
  for (const char* name : {"walk", "walk.part", "walk.part0", "walk.part10", ".part1"})
    EXPECT_FALSE(RunFolder::is_part_name(name)) << name;
}

TEST(RunFolder, ChecksumIsFnv1aAndDetectsOneChangedBit) {
  const TemporaryFolder folder;
  const auto path = folder.path / "f";
  std::ofstream(path) << "foobar";
  EXPECT_EQ(file_checksum(path), "85944171f73967e8");  // published test vector of FNV-1a, 64 bits
  std::ofstream(path) << "foobas";
  EXPECT_NE(file_checksum(path), "85944171f73967e8");
  EXPECT_THROW(file_checksum(folder.path / "none"), DataError);
  EXPECT_THROW(file_checksum(folder.path), DataError);
}

}  // namespace
}  // namespace mimicx::record
