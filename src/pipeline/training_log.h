/// The log of a training: a row per iteration, a column per number.
#pragma once

#include "record/table.h"
#include "rl/ppo.h"
#include "rl/tracking/tracking_environment.h"

namespace mimicx::pipeline {

/// The numbers of one iteration.
struct TrainingLogRow {
  rl::IterationStats iteration;
  rl::tracking::TrackingStatistics tracking;
  double sharpness = 1.0;
  double rollout_reward = 0.0;          ///< of the mean actions; NaN if they were not rolled out
  double rollout_position_error = 0.0;  ///< m; NaN likewise
};

/// The columns without rows.
record::Table empty_training_log();
/// Adds a row. @param log  begun by `empty_training_log`
void append(record::Table& log, const TrainingLogRow& row);

}  // namespace mimicx::pipeline
