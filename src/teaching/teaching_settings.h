/// How a policy is taught a planned motion, with every number by its name: for manifests and `--set`.
#pragma once

#include <string>

#include "core/named_values.h"
#include "teaching/student.h"

namespace mimicx::teaching {

struct TeachingConfig {
  bool teach = false;  ///< whether a plan that is followed teaches a policy: `adapt --policy`
  TeacherConfig teacher;
  StudentConfig student;
  /// Where the student alone does not follow the motion, PPO goes on with it, at most so many samples and
  /// until it does; 0: no PPO.
  std::int64_t polish_samples = 400000;
  /// PPO's mean reward, on the planned motion, at which it is done.
  double polish_reward = 0.6;
};

/// The numbers by name, all of them beginning with "teach_" or "polish_".
NamedValues teaching_settings(const TeachingConfig& config);

/// Changes one of them. @return whether there is one of that name
/// @throws std::invalid_argument for a fraction where a whole number is expected
bool change_setting(TeachingConfig& config, const std::string& name, double value);

/// @throws std::invalid_argument naming a setting that no teaching can have
void check(const TeachingConfig& config);

}  // namespace mimicx::teaching
