/// Trainings small enough for a test, and the context that they run in.
#pragma once

#include <sstream>
#include <string>

#include "program/configurations.h"

namespace mimicx::program {

/// Several iterations, groups and checkpoints.
inline pipeline::TrainingConfig small_training() {
  pipeline::TrainingConfig training = imitate_configuration().training;
  training.samples = 6 * 64 * 8;
  training.characters = 64;
  training.group_size = 16;
  training.hidden = {16};
  training.ppo.horizon = 8;
  training.ppo.minibatch = 256;
  training.ppo.pass_rows = 64;
  return training;
}

struct Outcome {
  record::RunOutcome value;
  std::string messages;
};

/// Calls work(context).
/// @param iterations  the context asks to stop after that many; negative: never
template <class Work>
Outcome run_in_context(const Work& work, int iterations = -1) {
  std::ostringstream messages;
  record::Progress progress(messages, false, record::steady_seconds);
  int asked = 0;
  const record::RunOutcome value =
      work(record::RunContext{progress, messages, [&] { return ++asked == iterations; }});
  return {value, messages.str()};
}

}  // namespace mimicx::program
