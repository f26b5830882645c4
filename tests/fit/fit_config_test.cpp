#include "fit/fit_config.h"

#include "core/setting_checks.h"

namespace mimicx::fit {
namespace {

TEST(FitSettings, EveryOneCanBeChangedByItsNameAndChangesNoOther) { check_settings(FitConfig{}); }

TEST(FitSettings, RejectsImpossibleValuesByName) {
  EXPECT_NO_THROW(check(FitConfig{}));
  for (const char* name : {"fit_iterations", "fit_keypoint_sigma", "fit_prior_frames", "fit_slip_sigma"}) {
    FitConfig config;
    apply_setting(config, name, 0.0);
    EXPECT_NE(refusal_of([&] { check(config); }).find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace mimicx::fit
