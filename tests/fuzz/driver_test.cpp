#include "fuzz/driver.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>

namespace mimicx::fuzz {
namespace {

const std::vector<std::string> kSeeds = {"OFFSET 1.5 2 3\n", "{\"Frames\": [[1, 2]]}"};

std::vector<std::string> fed;  ///< the inputs of `remember`
void remember(const std::string& bytes) { fed.push_back(bytes); }
void refuse_braces(const std::string& bytes) {
  if (bytes.find("}}") != std::string::npos) throw std::runtime_error("two braces");
}
void survive(const std::string&) {}

TEST(FuzzDriver, EqualArgumentsFeedEqualInputs) {
  fed.clear();
  ASSERT_EQ(run_fuzz({"--runs", "300", "--seed", "7"}, kSeeds, remember), 0);
  const std::vector<std::string> first = fed;
  fed.clear();
  ASSERT_EQ(run_fuzz({"--runs", "300", "--seed", "7"}, kSeeds, remember), 0);
  EXPECT_EQ(fed, first);
  EXPECT_GT(std::set<std::string>(first.begin(), first.end()).size(), 250u);
}

TEST(FuzzDriver, ReproducesAnInputByItsNumber) {
  fed.clear();
  ASSERT_EQ(run_fuzz({"--runs", "1", "--from", "41"}, kSeeds, remember), 0);
  EXPECT_EQ(fed.back(), mutated_input(kSeeds, 1, 41));
}

TEST(FuzzDriver, SeedsAndFilesAreFedUnchanged) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "mimicx_fuzz_driver_input";
  std::ofstream(path) << "as it is";
  fed.clear();
  ASSERT_EQ(run_fuzz({"--runs", "0", path.string()}, kSeeds, remember), 0);
  EXPECT_EQ(fed, (std::vector<std::string>{"as it is", kSeeds[0], kSeeds[1]}));
}

TEST(FuzzDriver, ReportsATargetThatThrows) {
  EXPECT_EQ(run_fuzz({"--runs", "20000"}, kSeeds, refuse_braces), 1);
}

TEST(FuzzDriver, RejectsWrongArguments) {
  EXPECT_EQ(run_fuzz({"--runs", "many"}, kSeeds, survive), 2);
  EXPECT_EQ(run_fuzz({"--runs"}, kSeeds, survive), 2);
  EXPECT_EQ(run_fuzz({"/no/such/file"}, kSeeds, survive), 2);
}

}  // namespace
}  // namespace mimicx::fuzz
