/// Settings of teaching a policy by a plan; every number has a name, for manifests and `--set`.
#pragma once

#include <string>

#include "core/named_values.h"
#include "teaching/student.h"

namespace mimicx::teaching {

struct TeachingConfig {
  bool teach = false;  ///< whether a complete plan teaches a policy: `adapt --policy`
  TeacherConfig teacher;
  StudentConfig student;
  /// Samples of PPO, at most, if the student does not follow the motion unaided; 0: no PPO.
  std::int64_t polish_samples = 400000;
  /// PPO ends at this mean reward on the planned motion.
  double polish_reward = 0.6;
};

/// The numbers by name; all begin with "teach_" or "polish_".
NamedValues teaching_settings(const TeachingConfig& config);

/// Changes one of them. @return whether the name exists
/// @throws std::invalid_argument for a fraction where a whole number is expected
bool change_setting(TeachingConfig& config, const std::string& name, double value);

/// @throws std::invalid_argument naming a setting that no teaching can have
void check(const TeachingConfig& config);

}  // namespace mimicx::teaching
