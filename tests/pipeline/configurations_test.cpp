#include "pipeline/configurations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

namespace mimicx {
namespace {

TrainingConfig training_of(std::size_t column) {
  switch (column) {
    case 0:
      return imitate_configuration().training;
    case 1:
      return adapt_configuration().training;
    default:
      return pretrain_configuration(column == 2 ? "small" : "paper").training;
  }
}

double value(const std::string& name, std::size_t column) {
  for (const ConfigurationRow& row : configuration_rows())
    if (row.name == name) return row.values[column];
  ADD_FAILURE() << "no row " << name;
  return 0.0;
}

// A setting of a training that the table lacks is a logic error of every column.
TEST(Configurations, AllAreCompleteAndCanBeTrained) {
  for (std::size_t column = 0; column < 4; ++column) EXPECT_NO_THROW(check(training_of(column))) << column;
}

TEST(Configurations, TheTaskIsOneForAll) {
  for (std::size_t column = 0; column < 4; ++column)
    EXPECT_EQ(settings_of(training_of(column).tracking), settings_of(rl::TrackingConfig{})) << column;
}

TEST(Configurations, NoSettingIsNamedTwice) {
  const std::vector<ConfigurationRow> rows = configuration_rows();
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(rows[i].name, rows[j].name);
}

TEST(Configurations, TheTableIsWhatManifestsRecord) {
  const auto has_all = [](std::size_t column, const NamedValues& settings) {
    for (const auto& [name, set] : settings) EXPECT_EQ(value(name, column), set) << name;
    std::size_t rows = 0;
    for (const ConfigurationRow& row : configuration_rows()) rows += !std::isnan(row.values[column]);
    const std::size_t budget = column == 4 ? 0 : 2;  // samples and seed; a plan has none
    EXPECT_EQ(rows, settings.size() + budget) << "in column " << column;
  };
  has_all(0, settings_of(imitate_configuration()));
  has_all(1, settings_of(adapt_configuration()));
  has_all(2, settings_of(pretrain_configuration("small")));
  has_all(3, settings_of(pretrain_configuration("paper")));
  has_all(4, settings_of(plan_configuration()));
}

TEST(Configurations, ThePresetsDifferInTheirNetworksAlone) {
  for (const ConfigurationRow& row : configuration_rows()) {
    if (row.name.starts_with("hidden_"))
      EXPECT_NE(row.values[2], row.values[3]) << row.name;
    else if (!std::isnan(row.values[2]) || !std::isnan(row.values[3]))
      EXPECT_EQ(row.values[2], row.values[3]) << row.name;
  }
  EXPECT_EQ(pretrain_configuration("paper").training.hidden, (std::vector<int>{1024, 1024, 512}));
  EXPECT_THROW(pretrain_configuration("large"), std::invalid_argument);
}

TEST(Configurations, TextAndJsonSayTheSame) {
  const nlohmann::json json = nlohmann::json::parse(configurations_json());
  std::istringstream lines(format_configurations());
  std::string line;
  std::getline(lines, line);  // the head
  for (const ConfigurationRow& row : configuration_rows()) {
    ASSERT_TRUE(std::getline(lines, line));
    std::istringstream words(line);
    std::string word;
    words >> word;
    EXPECT_EQ(word, row.name);
    for (std::size_t column = 0; column < 4; ++column) {
      words >> word;
      const nlohmann::json& settings = json.at(kConfigurationNames[column]);
      if (word == "-") {
        EXPECT_FALSE(settings.contains(row.name)) << row.name;
        continue;
      }
      EXPECT_EQ(std::stod(word), row.values[column]) << row.name;
      EXPECT_EQ(settings.at(row.name), row.values[column]) << row.name;
    }
  }
  EXPECT_FALSE(std::getline(lines, line));
}

}  // namespace
}  // namespace mimicx
