#include "control/linearisation.h"

namespace mimicx::control {

FrameMatrix linearise(const System& system, const FramePoint& point, const Linearisation& how) {
  switch (how.derivatives) {
    case Derivatives::kSmoothed:
      return linearise_smoothed(system, point, how.steps);
    case Derivatives::kColumns:
      break;
  }
  return linearise_by_columns(system, point, how.steps);
}

}  // namespace mimicx::control
