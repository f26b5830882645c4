#include "core/containers.h"

#include <gtest/gtest.h>

namespace mimicx {
namespace {

enum Colour : int { kRed, kGreen };

TEST(Containers, EveryIntegerTypeAndEnumeratorIsASubscript) {
  Array<double, 3> array = {1.0, 2.0, 3.0};
  List<double> list = {1.0, 2.0, 3.0};
  array[kGreen] = list[kGreen] = 7.0;
  for (const double found : {array[1], array[1L], array[std::size_t{1}], list[1], list[1L], list[1U]})
    EXPECT_EQ(found, 7.0);
  EXPECT_EQ(array[kRed], 1.0);
}

TEST(Containers, ConvertToStandardContainers) {
  const auto first_of = [](const std::vector<int>& v) { return v.front(); };
  const auto last_of = [](const std::array<int, 2>& a) { return a.back(); };
  EXPECT_EQ(first_of(List<int>(3, 5)), 5);
  EXPECT_EQ(last_of(Array<int, 2>{4, 6}), 6);
  EXPECT_EQ((List<int>(std::vector<int>{1, 2, 3}).count()), 3);
}

TEST(Containers, ListsOfFlagsAreWritableBySubscript) {
  List<bool> flags(4, false);
  flags[2] = true;
  EXPECT_EQ(flags, (std::vector<bool>{false, false, true, false}));
}

}  // namespace
}  // namespace mimicx
