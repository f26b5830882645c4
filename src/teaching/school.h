/// Teaches one policy many motions: each round records lessons in some of the motions and regresses onto
/// them.
///
/// Unlike the student of one plan (student.h), a pupil keeps no lessons from round to round, because those of
/// a thousand motions do not fit into memory. A round visits as many motions as it has packs; the order is
/// shuffled again whenever all have been visited.
///
/// `Pupil` has everything that later rounds depend on: a training that was interrupted after a round
/// continues with the same bytes.
#pragma once

#include <functional>
#include <string>

#include "control/plan_control.h"
#include "core/npz/npz.h"
#include "teaching/lessons.h"
#include "teaching/regression.h"

namespace mimicx::teaching {

struct SchoolConfig {
  std::vector<int> hidden = {128, 128};  ///< widths of the hidden layers
  int rounds = 150;                      ///< total; the step size depends on how many are left
  int packs = 64;                        ///< motions of a round; a pack of characters goes through each
  double passes = 4;                     ///< passes over the lessons of a round
  double step_size = 1e-3;  ///< Adam's first step size; falls with the square of the remaining share
  double last_step_size = 2e-5;
  bool weigh = true;         ///< weigh errors by Teacher::importance; otherwise all equally
  bool mirror = true;        ///< every other visit of a motion uses its mirror image
  bool follow_plan = false;  ///< the pupil observes the planned motions instead of their references
  bool see_shape = false;    ///< whether the pupil observes β, which could identify a motion
  std::uint64_t seed = 1;
  /// Less disturbed than those of one plan: the policy must also hold the body in motions without a plan.
  LessonConfig lessons{.action_noise = 0.03, .push = 0.08, .off_path = 0.25};
  RegressionConfig regression{.minibatch = 512};
};

/// core/setting.h; all but seed and rounds.
void visit_settings(SchoolConfig& school, const auto& visit) {
  for (std::size_t layer = 0; layer < school.hidden.size(); ++layer)
    visit("hidden_" + std::to_string(layer + 1), school.hidden[layer], 1, 4096, "units of that hidden layer");
  visit("passes", school.passes, 0, 1000, "how often the lessons of a round are gone over");
  visit("weigh", school.weigh, 0, 1, "1: errors count by what they cost the plan; 0: all alike");
  visit("mirror", school.mirror, 0, 1, "1: every other visit is to the motion's mirror image");
  visit("follow_plan", school.follow_plan, 0, 1, "1: policies see the plan; 0: its reference");
  visit("see_shape", school.see_shape, 0, 1, "1: policies see the body's shape");
  visit_settings(school.lessons, visit);
}

/// A pupil between two rounds.
struct Pupil : PolicyInTraining {
  int rounds = 0;          ///< done
  std::int64_t taken = 0;  ///< lessons so far
};

struct SchoolRound {
  int round = 0;
  int lessons = 0;
  double put_back = 0.0;  ///< resets per thousand lessons
  double loss = 0.0;      ///< mean over the round's steps
};

/// The teachers by number. Called from several threads at once.
using Teachers = std::function<Teacher(int)>;

Pupil untrained_pupil(const SchoolConfig& config, int state_size = rl::tracking::kStateSize);

/// The next round. @param count  of teachers
/// @return none if it was stopped; then the pupil is unchanged
std::optional<SchoolRound> teach_round(const Teachers& teachers, int count,
                                       const rl::tracking::TrackingConfig& task, const SchoolConfig& config,
                                       const control::PlanControl& control, Pupil& pupil);

void save(Npz& archive, const std::string& prefix, const Pupil& pupil);
/// @throws DataError naming archive and key
Pupil load_pupil(const Npz& archive, const std::string& prefix);

}  // namespace mimicx::teaching
