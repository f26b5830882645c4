#include "judge/choice.h"
#include "core/number_text.h"

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
  return formatted("%s, MPJPE %.1f mm", candidate.success ? "success" : "no success", candidate.mpjpe_mm);
}

}  // namespace mimicx::judge
