#include "record/progress.h"

#include <gtest/gtest.h>

#include <sstream>

namespace mimicx::record {
namespace {

TEST(Progress, RateAndTimeLeftCountThisRunOnly) {
  std::ostringstream out;
  double now = 100.0;
  Progress progress(out, false, [&now] { return now; });
  progress.start("walk", 500e3, 2e6);  // half a million samples came from a checkpoint
  now += 10.0;
  progress.update(700e3, "reward 0.500");  // 200k in 10 s; 1.3M to go at 20k/s
  EXPECT_EQ(out.str(), "walk  700.0k of 2.00M samples  35 %  20.0k/s  1 min 05 s left  reward 0.500\n");
}

TEST(Progress, PlainLogGetsALineEveryTenSeconds) {
  std::ostringstream out;
  double now = 0.0;
  Progress progress(out, false, [&now] { return now; });
  progress.start("walk", 0.0, 1e6);
  for (int i = 0; i < 100; ++i) {
    now += 1.0;
    progress.update(1e4 * i, "");
  }
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(Progress, TerminalGetsOneLineClearedAtTheEnd) {
  std::ostringstream out;
  double now = 0.0;
  Progress progress(out, true, [&now] { return now; });
  progress.start("walk", 0.0, 1e6);
  for (int i = 0; i < 10; ++i) {
    now += 1.0;
    progress.update(1e4 * i, "");
  }
  progress.finish("walk: ok");
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 11);
  EXPECT_TRUE(text.ends_with("\r\x1b[Kwalk: ok\n"));
}

TEST(Progress, FormatsCountsAndDurations) {
  EXPECT_EQ(format_count(950), "950");
  EXPECT_EQ(format_count(18200), "18.2k");
  EXPECT_EQ(format_count(4e6), "4.00M");
  EXPECT_EQ(format_duration(5.4), "5 s");
  EXPECT_EQ(format_duration(151), "2 min 31 s");
  EXPECT_EQ(format_duration(3960), "1 h 06 min");
  EXPECT_EQ(format_duration(-1), "0 s");
}

}  // namespace
}  // namespace mimicx::record
