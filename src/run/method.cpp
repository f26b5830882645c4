#include "run/method.h"

#include <algorithm>

namespace mimicx::run {

SequenceJob after_seconds(const SequenceJob& job, double seconds) {
  SequenceJob rest = job;
  if (job.limit_seconds > 0.0) rest.limit_seconds = std::max(job.limit_seconds - seconds, 1e-9);
  return rest;
}

}  // namespace mimicx::run
