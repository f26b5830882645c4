/// Tells a plan or a teaching of one motion when to stop, and remembers why it did.
#pragma once

#include "control/plan_control.h"
#include "run/sequence_run.h"

namespace mimicx::plan {

/// Must stay where it is while a control of it is in use.
struct JobWatch {
  const run::SequenceJob& job;
  double started = record::steady_seconds();
  bool interrupted = false;  ///< the context asked to stop
  bool timed_out = false;    ///< the job's seconds were over

  control::PlanControl control() {
    control::PlanControl control;
    control.threads = job.threads;
    control.should_stop = [this] {
      interrupted = interrupted || job.context.should_stop();
      timed_out = job.limit_seconds > 0.0 && record::steady_seconds() - started > job.limit_seconds;
      return interrupted || timed_out;
    };
    return control;
  }
};

}  // namespace mimicx::plan
