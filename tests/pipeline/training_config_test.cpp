#include "pipeline/training_config.h"

#include "core/setting_checks.h"

namespace mimicx::pipeline {
namespace {

TEST(TrainingSettings, EveryOneCanBeChangedByItsNameAndChangesNoOther) { check_settings(TrainingConfig{}); }

TEST(TrainingSettings, RejectsImpossibleValuesByName) {
  EXPECT_NO_THROW(check(TrainingConfig{}));
  for (const auto& [name, value] : std::vector<std::pair<const char*, double>>{{"characters", 0},
                                                                               {"characters", 100},
                                                                               {"group_size", 0},
                                                                               {"hidden_1", 0},
                                                                               {"hidden_2", 1e6},
                                                                               {"evaluate_iterations", 0},
                                                                               {"horizon", 0},
                                                                               {"gamma", 1.5},
                                                                               {"sigma_start", 0},
                                                                               {"epochs", 0},
                                                                               {"minibatch", 0},
                                                                               {"step_size", -1},
                                                                               {"pass_rows", 0},
                                                                               {"uniform_starts", 2},
                                                                               {"physics_passes", 0},
                                                                               {"physics_rate", 100}}) {
    TrainingConfig config;
    apply_setting(config, name, value);
    EXPECT_NE(refusal_of([&] { check(config); }).find(name), std::string::npos) << name << ' ' << value;
  }
}

}  // namespace
}  // namespace mimicx::pipeline
