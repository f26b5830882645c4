#include "core/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
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

TEST(ParallelFor, RethrowsTheErrorOfTheLowestChunkAfterAllChunks) {
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

TEST(ParallelChain, LinkRunsAfterItsItemAndThePreviousLink) {
  for (const int threads : {0, 1, 2, 5}) {
    std::vector<std::atomic<int>> items(50);
    int links = 0;  // not atomic: links run one at a time
    parallel_chain(
        50, threads,
        [&](int i, int worker) {
          EXPECT_TRUE(worker >= 0 && worker < std::max(threads, 1));
          ++items[static_cast<std::size_t>(i)];
        },
        [&](int i) {
          EXPECT_EQ(links++, i) << threads;
          EXPECT_EQ(items[static_cast<std::size_t>(i)], 1) << threads;
        });
    EXPECT_EQ(links, 50);
    for (const auto& n : items) EXPECT_EQ(n, 1) << threads;
  }
  parallel_chain(
      0, 2, [](int, int) { FAIL() << "there is no item"; }, [](int) { FAIL() << "there is no link"; });
}

/// The last item waits for a link that can only run on the other thread.
TEST(ParallelChain, RunsLinksConcurrentlyWithLaterItems) {
  std::atomic<bool> linked = false;
  parallel_chain(
      3, 2,
      [&](int i, int) {
        while (i == 2 && !linked) std::this_thread::yield();
      },
      [&](int i) {
        if (i == 1) linked = true;
      });
  EXPECT_TRUE(linked);
}

TEST(ParallelChain, RethrowsAfterAllItemsAndStopsTheLinks) {
  for (const int threads : {1, 2}) {
    std::atomic<int> ended = 0;
    int links = 0;
    const auto chain = [&] {
      parallel_chain(
          8, threads,
          [&](int i, int) {
            ++ended;
            if (i == 6) throw std::runtime_error("item");
          },
          [&](int i) {
            ++links;
            if (i == 3) throw std::runtime_error("link");
          });
    };
    EXPECT_THROW(chain(), std::runtime_error);
    EXPECT_EQ(ended, 8);
    EXPECT_LE(links, 4);
  }
}

}  // namespace
}  // namespace mimicx
