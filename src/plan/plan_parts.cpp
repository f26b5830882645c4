#include "plan/plan_parts.h"

#include <algorithm>
#include <cmath>

#include "audit/pose_verdict.h"
#include "judge/scores.h"
#include "plan/plan_motion.h"
#include "plan/reference_factors.h"

namespace mimicx::plan {
namespace {

constexpr double kShortest = 1.0;    ///< s
constexpr double kBehindLoss = 0.5;  ///< s after a loss until the next attempt
constexpr int kFeasibleAround = 2;   ///< frames before and behind the first one of an attempt
constexpr int kAttemptsInVain = 5;   ///< that gave no part
constexpr int kBacktracks = 2;       ///< of an attempt

template <class Item>
PerFrame<Item> cut(const PerFrame<Item>& all, int first, int count) {
  if (all.empty()) return all;
  return std::vector<Item>(all.begin() + first, all.begin() + first + count);
}

/// Frames of a reference, as a reference without keypoints.
motion::Reference stretch_of(const motion::Reference& all, int first, int count) {
  motion::Reference some;
  some.name = all.name;
  some.fps = all.fps;
  some.character = all.character;
  some.scene = all.scene;
  some.frames = cut(all.frames, first, count);
  some.poses = cut(all.poses, first, count);
  some.flagged = cut(all.flagged, first, count);
  return some;
}

rl::tracking::TrackingRollout beginning_of(rl::tracking::TrackingRollout rollout, int count) {
  const auto n = static_cast<std::size_t>(count);
  rollout.poses.resize(n);
  rollout.rewards.resize(n);
  rollout.forces.resize(n);
  rollout.substeps.clear();
  return rollout;
}

int seconds_in_frames(double seconds, double fps) { return static_cast<int>(std::ceil(seconds * fps)); }

/// The first frame from `from` on with feasible frames around it; behind the last frame if there is none.
int next_start(const audit::PoseNeeds& needs, int from, int frames) {
  if (needs.frames.count() != frames) return from;
  int good = 0;  // feasible frames in a row
  for (int t = std::max(0, from - kFeasibleAround); t < frames; ++t) {
    good = audit::wrong_with(needs.frames[t], needs.weight) == audit::Wrong::kNothing ? good + 1 : 0;
    if (good > 2 * kFeasibleAround) return t - kFeasibleAround;
  }
  return frames;
}

/// Adds the followed beginning of a motion. @return whether it is long enough and a success
bool add_part(const motion::Reference& reference, int first, const rl::tracking::TrackingRollout& rollout,
              run::FollowedParts& found) {
  const int count = followed_frames(reference, rollout);
  if (count < seconds_in_frames(kShortest, reference.fps)) return false;
  run::FollowedPart part{first, stretch_of(reference, 0, count), beginning_of(rollout, count)};
  if (!judge::score_simulated(part.reference, part.rollout).success) return false;
  found.parts.push_back(std::move(part));
  return true;
}

}  // namespace

int followed_frames(const motion::Reference& reference, const rl::tracking::TrackingRollout& rollout) {
  const int frames = std::min(reference.size(), static_cast<int>(rollout.poses.size()));
  int followed = 0;
  for (int t = 0; t < frames; ++t) {
    double sum = 0.0, largest = 0.0;
    for (int b = 0; b < kBodies; ++b) {
      const double distance =
          (rollout.poses[static_cast<std::size_t>(t)].p_WB[b] - reference.poses[t].p_WB[b]).norm();
      sum += distance;
      largest = std::max(largest, distance);
    }
    if (!(largest <= motion::kMaxBodyDistance)) break;
    if (sum <= motion::kMaxMeanDistance * kBodies) followed = t + 1;
  }
  return followed;
}

run::FollowedParts followed_parts(const motion::Reference& reference, const PlanningConfig& config,
                                  const rl::tracking::TrackingRollout& failed, const run::SequenceJob& job) {
  run::FollowedParts found;
  run::JobWatch watch{job};
  add_part(reference, 0, failed, found);
  int end = followed_frames(reference, failed);
  MotionPlanConfig settings = config.plan;
  settings.assisted_stages = false;
  settings.horizon.backtracks = std::min(settings.horizon.backtracks, kBacktracks);
  int in_vain = 0;
  while (found.parts.count() < record::kMostParts && in_vain < kAttemptsInVain) {
    const int first =
        next_start(job.needs, end + seconds_in_frames(kBehindLoss, reference.fps), reference.size());
    if (reference.size() - first < seconds_in_frames(kShortest, reference.fps)) break;
    const motion::Reference rest = stretch_of(reference, first, reference.size() - first);
    audit::PoseNeeds needs = job.needs;
    needs.frames =
        cut(needs.frames, std::min(first, needs.frames.count()), std::max(0, needs.frames.count() - first));
    settings.factors = factors_of(rest, needs, settings);
    const rl::tracking::TrackingRollout made = planned_rollout(rest, config.simulation, settings, watch);
    if (watch.interrupted || watch.timed_out) break;
    if (!add_part(rest, first, made, found)) ++in_vain;
    const int followed = followed_frames(rest, made);
    end = first + followed;
    if (end >= reference.size()) break;
  }
  found.interrupted = watch.interrupted;
  found.timed_out = watch.timed_out;
  found.seconds = record::steady_seconds() - watch.started;
  return found;
}

}  // namespace mimicx::plan
