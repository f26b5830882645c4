#include "character/body_words.h"

#include <gtest/gtest.h>

#include "character/bodies.h"

namespace mimicx {
namespace {

TEST(BodyWords, SpellBodyNamesWithSpaces) {
  EXPECT_EQ(body_in_words(kLeftFoot), "left foot");
  EXPECT_EQ(body_in_words(kPelvis), "pelvis");
  for (int b = 0; b < kBodies; ++b)
    EXPECT_EQ(body_in_words(b).find_first_not_of("abcdefghijklmnopqrstuvwxyz123 "), std::string::npos) << b;
}

}  // namespace
}  // namespace mimicx
