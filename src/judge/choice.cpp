#include "judge/choice.h"

#include <cstdio>

namespace mimicx::judge {

Candidate candidate_of(const motion::Reference& reference, const rl::tracking::TrackingRollout& rollout) {
  const Scores scores = score_simulated(reference, rollout);
  return {scores.success, static_cast<int>(rollout.poses.size()), value_of(scores.values, "MPJPE")};
}

bool better(const Candidate& a, const Candidate& b) {
  if (a.success != b.success) return a.success;
  if (a.frames != b.frames) return a.frames > b.frames;
  return a.mpjpe_mm < b.mpjpe_mm;
}

std::string in_words(const Candidate& candidate) {
  char text[64];
  std::snprintf(text, sizeof text, "%s, MPJPE %.1f mm", candidate.success ? "success" : "no success",
                candidate.mpjpe_mm);
  return text;
}

}  // namespace mimicx::judge
