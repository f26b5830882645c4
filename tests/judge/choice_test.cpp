#include "judge/choice.h"

#include <gtest/gtest.h>

namespace mimicx::judge {
namespace {

TEST(Choice, SuccessComesFirst) {
  EXPECT_TRUE(better({true, 10, 59.0}, {false, 100, 1.0}));
  EXPECT_FALSE(better({false, 100, 1.0}, {true, 10, 59.0}));
}

TEST(Choice, LongerMotionBeatsACloserShorterOne) {
  EXPECT_TRUE(better({false, 100, 80.0}, {false, 99, 1.0}));
  EXPECT_FALSE(better({false, 99, 1.0}, {false, 100, 80.0}));
}

TEST(Choice, CloserOneWinsAtEqualLengthAndNoneBeatsItself) {
  EXPECT_TRUE(better({true, 100, 1.0}, {true, 100, 2.0}));
  EXPECT_FALSE(better({true, 100, 2.0}, {true, 100, 1.0}));
  EXPECT_FALSE(better({true, 100, 1.0}, {true, 100, 1.0}));
}

}  // namespace
}  // namespace mimicx::judge
