#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace mimicx {
namespace {

TEST(ParallelFor, CallsEveryChunkOnceForAnyNumberOfThreads) {
  for (const int threads : {0, 1, 2, 5}) {
    std::vector<std::atomic<int>> calls(17);
    parallel_for(17, threads, [&](int chunk) { ++calls[static_cast<std::size_t>(chunk)]; });
    for (const auto& n : calls) EXPECT_EQ(n, 1) << threads;
  }
  parallel_for(0, 2, [](int) { FAIL() << "there is no chunk"; });
}

TEST(ParallelFor, RethrowsTheErrorOfTheLowestChunkAfterAllHaveEnded) {
  for (const int threads : {1, 2}) {
    std::atomic<int> ended = 0;
    try {
      parallel_for(8, threads, [&](int chunk) {
        ++ended;
        if (chunk == 3 || chunk == 6) throw std::runtime_error(std::to_string(chunk));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "3");
    }
    EXPECT_EQ(ended, 8);
  }
}

}  // namespace
}  // namespace mimicx
