#include "report/glossary.h"

#include <gtest/gtest.h>

#include "motion/metrics.h"
#include "rl/tracking/reward.h"

namespace mimicx::report {
namespace {

bool is_a_key(const std::string& text) { return text.find('_') != std::string::npos; }

TEST(Glossary, EveryMetricHasWordsDefinitionAndUnit) {
  for (const motion::MetricDefinition& d : motion::metric_definitions()) {
    EXPECT_TRUE(has_words("metrics", d.name)) << d.name;
    const Words words = words_of_metric(d.name);
    EXPECT_NE(words.words, d.name);
    EXPECT_EQ(words.meaning, d.definition);
    EXPECT_EQ(words.unit.find('^'), std::string::npos) << words.unit;
    EXPECT_FALSE(words.unit.empty()) << d.name;
  }
  EXPECT_EQ(words_of_metric("Accel").unit, "mm/frame²");
  EXPECT_EQ(words_of_metric("Jitter").unit, "10 m/s³");
}

TEST(Glossary, RewardFactorsHaveWords) {
  for (const std::string_view name : rl::tracking::kRewardTermNames)
    EXPECT_FALSE(is_a_key(words_of_line(std::string(name)))) << name;
  EXPECT_NE(words_of_line("projection"), "projection");
}

TEST(Glossary, GroupEntriesPrecedeGeneralOnes) {
  EXPECT_EQ(words_of_value("fit", "change_mean_mm").words,
            words_of_value("preparation", "change_mean_mm").words);
  EXPECT_NE(words_of_value("fit", "iterations").words, words_of_value("plan", "iterations").words);
}

TEST(Glossary, UnknownNameIsShownWithBlanks) {
  EXPECT_FALSE(has_words("fit", "some_new_number"));
  EXPECT_EQ(words_of_value("fit", "some_new_number").words, "some new number");
  EXPECT_EQ(words_of_log("some_new_column").words, "some new column");
  EXPECT_EQ(words_of_metric("some_new_metric").words, "some new metric");
}

}  // namespace
}  // namespace mimicx::report
