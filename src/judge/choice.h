/// Which of two simulated motions of one clip is written.
#pragma once

#include "judge/scores.h"

namespace mimicx::judge {

/// The numbers that decide the choice.
struct Candidate {
  bool success = false;  ///< docs/metrics.md
  int frames = 0;        ///< that were simulated
  double mpjpe_mm = 0;   ///< to the prepared reference
};
Candidate candidate_of(const motion::Reference& reference, const rl::tracking::TrackingRollout& rollout);

/// Success comes first, then how many frames were simulated, then the smaller MPJPE.
bool better(const Candidate& a, const Candidate& b);

/// "success, MPJPE 3.2 mm"
std::string in_words(const Candidate& candidate);

}  // namespace mimicx::judge
