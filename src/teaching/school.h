/// One policy for many motions: rounds of lessons in motions that come in turn, and regression onto them.
///
/// Unlike the student of one plan (student.h), a pupil keeps no lessons from round to round: what a thousand
/// motions have to say does not fit into memory, and the next round brings it up to date. A round visits as
/// many motions as it has packs, in an order that is shuffled anew whenever all have been visited.
///
/// Everything that a pupil's future depends on is in `Pupil`: a training that was interrupted after a round
/// goes on with the same bytes.
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
  int rounds = 150;                      ///< in all; the step size depends on how many are left
  int packs = 64;                        ///< motions of a round; a pack of characters goes through each
  double passes = 4;                     ///< how often the lessons of a round are gone over
  double step_size = 1e-3;               ///< Adam's at first; falls with the square of what is left
  double last_step_size = 2e-5;
  double decay = 0.0;        ///< every step takes so many of its sizes off the weights (AdamW)
  bool weigh = true;         ///< errors count by Teacher::importance; otherwise all alike
  bool mirror = true;        ///< every other time a motion is visited, in its mirror image
  bool follow_plan = false;  ///< the pupil sees the planned motions instead of what was planned for
  bool see_shape = false;    ///< whether the pupil sees β; it can tell motions apart by it
  std::uint64_t seed = 1;
  /// Calmer than those of one plan: what holds a body here has to hold it in motions that no plan has seen.
  LessonConfig lessons{.action_noise = 0.03, .push = 0.08, .off_path = 0.25};
  RegressionConfig regression{.minibatch = 512};
};

/// A pupil between two rounds.
struct Pupil {
  rl::Agent agent;
  nn::Adam<float> adam;
  int rounds = 0;          ///< done
  std::int64_t taken = 0;  ///< lessons so far
};

struct SchoolRound {
  int round = 0;
  int lessons = 0;
  double put_back = 0.0;  ///< bodies that left the path, per thousand lessons
  double loss = 0.0;      ///< mean over the round's steps
};

/// The teachers by number. Called from several threads at once.
using Teachers = std::function<Teacher(int)>;

Pupil new_pupil(const SchoolConfig& config, int state_size = rl::tracking::kStateSize);

/// The next round. @param count  of teachers
/// @return none where it was told to stop; then the pupil is as before
std::optional<SchoolRound> teach_round(const Teachers& teachers, int count,
                                       const rl::tracking::TrackingConfig& task, const SchoolConfig& config,
                                       const control::PlanControl& control, Pupil& pupil);

void save(Npz& archive, const std::string& prefix, const Pupil& pupil);
/// @throws DataError naming archive and key
Pupil load_pupil(const Npz& archive, const std::string& prefix);

}  // namespace mimicx::teaching
