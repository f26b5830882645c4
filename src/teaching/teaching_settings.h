/// How a policy is taught a planned motion, with every setting by its name: for manifests and `--set`.
#pragma once

#include "core/setting.h"
#include "teaching/student.h"

namespace mimicx::teaching {

struct TeachingConfig {
  bool teach = false;  ///< whether a complete plan teaches a policy: `adapt --policy`
  TeacherConfig teacher;
  StudentConfig student;
  /// Samples of PPO, at most, if the student does not follow the motion unaided; 0: no PPO.
  std::int64_t polish_samples = 400000;
  /// PPO ends where a roll-out of the mean action has this mean reward (not softened) on the planned motion.
  double polish_reward = 0.6;
};

/// core/setting.h.
void visit_settings(TeachingConfig& config, const auto& visit) {
  visit("teach", config.teach, 0, 1, "1: a plan that is followed teaches a policy (--policy)");
  visit_settings(config.student, with_prefix("teach_", visit));
  visit("polish_samples", config.polish_samples, 0, 1e9,
        "PPO's budget where a taught policy fails, character steps; 0: no PPO");
  visit("polish_reward", config.polish_reward, 0, 1,
        "mean reward of a mean-action roll-out, not softened, that ends this PPO");
}

}  // namespace mimicx::teaching
