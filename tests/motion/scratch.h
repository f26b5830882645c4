/// Files that a test writes.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace mimicx::test {

/// A path in a folder of the running test's own: tests run side by side.
inline std::filesystem::path scratch(const std::string& name) {
  const ::testing::TestInfo& test = *::testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) /
                                       (std::string("mimicx_") + test.test_suite_name()) / test.name();
  std::filesystem::create_directories(folder);
  return folder / name;
}

}  // namespace mimicx::test
