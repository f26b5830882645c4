/// Where and why a result is worse than its input in a headline measure (headline.h).
///
/// A measure is worse if its printed number is larger than the input's. Its frames are those with at least a
/// quarter of the largest excess over the input; the three stretches with the most excess are named. Why, by
/// the first of these that holds:
///  1. of sinking: the input hangs over the floor there;
///  2. the prepared reference has at least half of the result's fault there;
///  3. no body could follow the reference there (audit/pose_verdict.h);
///  4. of sliding: the reference moves the foot that carries the body in the result; of sinking: the
///     simulated floor gives way under load, by 5 mm at most; of jitter: a foot lands;
///  5. none: the result alone has it.
#pragma once

#include "audit/pose_needs.h"
#include "core/named_values.h"
#include "judge/scores.h"
#include "motion/reference.h"
#include "record/sequence_entry.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::judge {

/// What a result is compared with.
struct Origin {
  const motion::Clip& input;
  const motion::Reference& reference;
  const audit::PoseNeeds& needs;  ///< of the reference; may be without frames
  const InputScores& input_scores;
};

/// @param metrics  of the result, as score_simulated gives them
/// @return none if input and result differ in length
std::vector<record::Worsening> worsenings(const Origin& origin, const rl::tracking::TrackingRollout& rollout,
                                          const NamedValues& metrics);

}  // namespace mimicx::judge
