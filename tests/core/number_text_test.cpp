#include "core/number_text.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "core/random.h"
#include "core/temporary_folder.h"

namespace mimicx {
namespace {

TEST(NumberText, RoundTripKeepsTheNumber) {
  Random random(1, {});
  for (int k = 0; k < 100000; ++k) {
    const double value = std::ldexp(random.uniform(-1.0, 1.0), static_cast<int>(random.uniform(-60.0, 60.0)));
    ASSERT_EQ(number_from(text_of(value)), value);
  }
  EXPECT_EQ(text_of(0.1), "0.1");
  EXPECT_EQ(text_of(-3.0), "-3");
}

TEST(Formatted, IsWhatPrintfWritesOfAnyLength) {
  EXPECT_EQ(formatted("%d of %s, %.1f %%", 3, "four", 75.0), "3 of four, 75.0 %");
  EXPECT_EQ(formatted("nothing"), "nothing");
  EXPECT_EQ(formatted("%s", ""), "");
  const std::string longest(100'000, 'x');
  EXPECT_EQ(formatted("%s%d", longest.c_str(), 1), longest + "1");
}

TEST(NumberText, DecimalsHaveAPointWhateverTheLocaleOfTheHost) {
  const TemporaryFolder folder;
  const std::string name = (folder.path / "de_DE.UTF-8").string();
  if (std::system(("localedef -i de_DE -f UTF-8 " + name + " >/dev/null 2>&1").c_str()) != 0 &&
      !std::filesystem::exists(name))
    GTEST_SKIP() << "no sources of locales here (Debian: locales)";
  setenv("LOCPATH", folder.path.c_str(), 1);
  ASSERT_TRUE(std::setlocale(LC_ALL, "de_DE.UTF-8"));
  char theirs[8];
  std::snprintf(theirs, sizeof theirs, "%.1f", 1.5);
  EXPECT_STREQ(theirs, "1,5") << "the locale has no decimal comma";
  EXPECT_EQ(formatted("%.1f", 1.5), "1.5");
  EXPECT_EQ(text_of(1.5), "1.5");
  EXPECT_EQ(number_from("1.5"), 1.5);
  std::snprintf(theirs, sizeof theirs, "%.1f", 1.5);
  EXPECT_STREQ(theirs, "1,5") << "the host's locale stays";
  std::setlocale(LC_ALL, "C");
  unsetenv("LOCPATH");
}

TEST(NumberText, OneThingIsSingular) {
  EXPECT_EQ(counted(1, "frame"), "1 frame");
  EXPECT_EQ(counted(0, "frame") + ", " + counted(12, "time"), "0 frames, 12 times");
}

TEST(NumberText, AcceptsNumbersOnly) {
  EXPECT_EQ(number_from("-1.5e3"), -1500.0);
  EXPECT_EQ(number_from(".5"), 0.5);
  EXPECT_EQ(number_from("inf"), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(number_from("nan").value()));
  EXPECT_EQ(number_from("1e-400"), 0.0);
  EXPECT_EQ(number_from("-0.00001e-399"), 0.0);
  EXPECT_EQ(number_from("4.9406564584124654e-324"), 4.9406564584124654e-324) << "a subnormal number";
  for (const char* text : {"", " 1", "1 ", "+1", "1,5", "0x10", "1e", "one", "1e999", "--1"})
    EXPECT_FALSE(number_from(text).has_value()) << text;
}

}  // namespace
}  // namespace mimicx
