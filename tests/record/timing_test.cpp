#include "record/timing.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/file.h"
#include "core/temporary_folder.h"

namespace mimicx::record {
namespace {

TEST(Timing, RoundTripsAndReadsAnInvalidFileAsEmpty) {
  const TemporaryFolder folder;
  const auto path = folder.path / "timing.json";
  EXPECT_TRUE(read_timing(path).empty());
  SequenceEntry walk;
  walk.name = "walk";
  walk.samples = 4'000'000;
  std::ofstream(path) << format_timing({{"walk", 12.5, 1.5, 10.0, 2}}, {walk});
  ASSERT_EQ(read_timing(path).size(), 1u);
  EXPECT_EQ(read_timing(path)[0].planning_seconds, 1.5);
  EXPECT_EQ(read_timing(path)[0].training_seconds, 10.0);
  EXPECT_NE(read_file(path).find("\"samples_per_second\": 400000.0"), std::string::npos);
  std::ofstream(path) << "{";
  EXPECT_TRUE(read_timing(path).empty());
}

}  // namespace
}  // namespace mimicx::record
