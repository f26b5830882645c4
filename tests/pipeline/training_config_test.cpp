#include "pipeline/training_config.h"

#include <gtest/gtest.h>

#include <cmath>

#include "program/configurations.h"

namespace mimicx::pipeline {
namespace {

TEST(TrainingSettings, EachChangesByNameAndAlone) {
  const NamedValues defaults = settings_of(program::imitate_configuration().training);
  for (const auto& [name, value] : defaults) {
    const bool flag = name == "residual_actions" || name == "self_contact" || name == "velocity_feed_forward";
    const double other = flag ? 1.0 - value : value + 1.0;
    TrainingConfig config = program::imitate_configuration().training;
    apply_setting(config, name, other);
    const NamedValues changed = settings_of(config);
    for (std::size_t k = 0; k < defaults.size(); ++k)
      EXPECT_EQ(changed[k].second, defaults[k].first == name ? other : defaults[k].second) << name;
  }
  TrainingConfig config = program::imitate_configuration().training;
  EXPECT_THROW(apply_setting(config, "no_such_setting", 1.0), std::invalid_argument);
  EXPECT_THROW(apply_setting(config, "epochs", 1.5), std::invalid_argument);
}

TEST(TrainingSettings, RejectsImpossibleValuesByName) {
  for (const char* name :
       {"characters", "group_size", "hidden_1", "evaluate_iterations", "horizon", "sigma_start", "epochs",
        "minibatch", "gradient_slots", "pass_rows", "bin_frames", "physics_passes"}) {
    TrainingConfig config = program::imitate_configuration().training;
    apply_setting(config, name, 0.0);
    EXPECT_THROW(check(config), std::invalid_argument) << name;
  }
  for (const auto& [name, value] : std::vector<std::pair<const char*, double>>{{"gamma", 1.5},
                                                                               {"characters", 100},
                                                                               {"physics_rate", 100},
                                                                               {"step_size", -1},
                                                                               {"hidden_2", 1e6}}) {
    TrainingConfig config = program::imitate_configuration().training;
    apply_setting(config, name, value);
    EXPECT_THROW(check(config), std::invalid_argument) << name;
  }
  TrainingConfig config = program::imitate_configuration().training;
  for (const double value : {1e12, HUGE_VAL, std::nan("")})
    EXPECT_THROW(apply_setting(config, "epochs", value), std::invalid_argument);
  EXPECT_NO_THROW(check(config));
}

TEST(TrainingSettings, NameEveryParameterOnce) {
  const NamedValues values = settings_of(program::imitate_configuration().training);
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(values[i].first, values[j].first);
}

}  // namespace
}  // namespace mimicx::pipeline
