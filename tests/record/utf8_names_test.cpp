#include "record/utf8_names.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/random.h"

namespace mimicx::record {
namespace {

TEST(Utf8Names, UnicodeIsUnchanged) {
  for (const std::string name : {"walk", "", "Hüfte/骨.npz", "🦴", "\x7f\x01"}) {
    EXPECT_EQ(to_utf8(name), name);
    EXPECT_EQ(from_utf8(name), name);
  }
}

TEST(Utf8Names, AnyBytesRoundTripThroughJsonAndStayDistinct) {
  Random random(11, {1});
  for (int round = 0; round < 2000; ++round) {
    std::string name;
    for (std::size_t n = random.bits() % 12; n-- > 0;)
      name +=
          static_cast<char>(round % 2 == 0 ? random.bits() : "\xEE\xBE\xBF\xC3\xA9\x80w/"[random.bits() % 8]);
    std::string text;
    ASSERT_NO_THROW(text = nlohmann::json(to_utf8(name)).dump());  // throws for what is no UTF-8
    EXPECT_EQ(from_utf8(nlohmann::json::parse(text).get<std::string>()), name);
  }
}

}  // namespace
}  // namespace mimicx::record
