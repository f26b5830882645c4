#include "import/evidence/frame_rate.h"

#include <gtest/gtest.h>

#include "core/number_text.h"

namespace mimicx::import {
namespace {

double rate_of(const std::string& text) { return rate_of_frame_time(text, number_from(text).value()); }

TEST(FrameRate, AFrameTimeOfFewDigitsIsTheRateInUse) {
  for (const auto& [text, rate] : {std::pair{"0.0333", 30.0},
                                   {"0.033", 30.0},
                                   {"0.0334", 30e3 / 1001},
                                   {"0.0083", 120.0},
                                   {"0.00833", 120.0},
                                   {"0.0166", 60.0},
                                   {"0.017", 60.0},
                                   {"0.016667", 60.0},
                                   {"0.0417", 24.0},
                                   {"0.04167", 24.0},
                                   {"3.33e-2", 30.0},
                                   {"0.0111", 90.0},
                                   {"0.0042", 240.0}})
    EXPECT_DOUBLE_EQ(rate_of(text), rate) << text;
}

TEST(FrameRate, RatesOfTelevisionAndExactOnesStay) {
  for (const auto& [text, rate] : {std::pair{"0.0333667", 29.97},
                                   {"0.0166833", 59.94},
                                   {"0.0417083", 23.976},
                                   {"0.01", 100.0},
                                   {"0.008", 125.0},
                                   {"0.04", 25.0},
                                   {"0.0125", 80.0},
                                   {"1", 1.0},
                                   {"0.0142857", 70.0},
                                   {"0.0271", 36.9}})
    EXPECT_NEAR(rate_of(text), rate, 1e-3 * rate) << text;
}

TEST(FrameRate, IsPrintedWithEveryDigitThatMatters) {
  EXPECT_EQ(rate_text(60e3 / 1001), "59.9401");
  EXPECT_EQ(rate_text(120.0), "120");
  EXPECT_EQ(rate_text(1.0 / 0.0083), "120.482");
}

TEST(FrameRate, WarnsOfRatesThatNoRecordingHas) {
  EXPECT_EQ(odd_rate_warnings(1.0, 150).size(), 1u);
  EXPECT_EQ(odd_rate_warnings(600.0, 150).size(), 1u);
  EXPECT_EQ(odd_rate_warnings(120.0, 120).size(), 1u) << "the number of frames";
  EXPECT_TRUE(odd_rate_warnings(120.0, 119).empty());
  EXPECT_TRUE(odd_rate_warnings(30.0, 30).empty()) << "a second at 30 fps";
}

}  // namespace
}  // namespace mimicx::import
