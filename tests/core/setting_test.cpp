#include "core/setting.h"

#include "core/setting_checks.h"

namespace mimicx {
namespace {

enum class Kind { kFirst, kSecond };

struct Part {
  double weight = 2.5;
};
void visit_settings(Part& part, const auto& visit) { visit("weight", part.weight, 0, 10, "of the part, kg"); }

struct Whole {
  int count = 3;
  bool flag = true;
  Kind kind = Kind::kFirst;
  Part part;
};
void visit_settings(Whole& whole, const auto& visit) {
  visit("count", whole.count, 1, 100, "how many");
  visit("flag", whole.flag, 0, 1, "1: yes");
  visit("kind", whole.kind, 0, 1, "0 first, 1 second");
  visit_settings(whole.part, with_prefix("part_", visit));
}

TEST(Settings, AreNumbersByNameInTheOrderOfTheVisit) {
  check_settings(Whole{});
  EXPECT_EQ(settings_of(Whole{}),
            (NamedValues{{"count", 3.0}, {"flag", 1.0}, {"kind", 0.0}, {"part_weight", 2.5}}));
  EXPECT_EQ(meanings_of(Whole{}).back(),
            (std::pair<std::string, std::string>{"part_weight", "of the part, kg"}));
}

TEST(Settings, AreSetAsTheTypeOfTheirField) {
  Whole whole;
  apply_setting(whole, "count", 7);
  apply_setting(whole, "flag", 0);
  apply_setting(whole, "kind", 1);
  apply_setting(whole, "part_weight", 0.5);
  EXPECT_EQ(whole.count, 7);
  EXPECT_FALSE(whole.flag);
  EXPECT_EQ(whole.kind, Kind::kSecond);
  EXPECT_EQ(whole.part.weight, 0.5);
}

TEST(Settings, AFieldKeepsItsValueWhereTheNumberIsRefused) {
  for (const double value : {1.5, 1e12, HUGE_VAL, std::nan("")}) {
    Whole whole;
    EXPECT_THROW(apply_setting(whole, "count", value), std::invalid_argument) << value;
    EXPECT_EQ(whole.count, 3);
  }
}

TEST(Settings, OneOutOfItsRangeIsNamedWithTheRange) {
  Whole whole;
  whole.part.weight = 11.0;
  EXPECT_EQ(refusal_of([&] { require_ranges(whole); }), "part_weight: expected 0 to 10, found 11");
  whole.part.weight = std::nan("");
  EXPECT_NE(refusal_of([&] { require_ranges(whole); }), "");
}

}  // namespace
}  // namespace mimicx
