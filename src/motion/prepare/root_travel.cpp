#include "motion/prepare/root_travel.h"

#include <algorithm>
#include <cmath>

#include "core/quantile.h"
#include "core/units.h"
#include "motion/prepare/stance.h"

namespace mimicx::motion {
namespace {

constexpr double kOnFeet = 0.25;   ///< m, of the lowest of hips, trunk and arms over the feet
constexpr double kContact = 0.04;  ///< m over the lowest height of the frames around
constexpr double kAround = 0.5;    ///< s
constexpr double kStretch = 0.2;   ///< s
constexpr double kWalking = 0.3;   ///< m/s
constexpr double kShortest = 0.3;  ///< m, of the way that feet walk
constexpr int kFewestStretches = 10;
constexpr double kDiffers = 0.8, kSlides = 0.3;  ///< shares of the way that feet walk

/// What happens from a frame to the next, along the floor.
struct Step {
  Vector3d walked;    ///< way of the pelvis if the lowest point of the feet stands still, m
  Vector3d moved;     ///< way of the pelvis in the motion, m
  double height = 0;  ///< of the lowest point of the feet
  int foot = 0;       ///< that point's; -1: the body is not on its feet
};

/// Whether hips, trunk and arms are over the feet.
bool is_on_feet(const BodyPoses& pose, double height) {
  for (int b = 0; b < kBodies; ++b)
    if (b != kLeftKnee && b != kRightKnee && b != kLeftAnkle && b != kRightAnkle && b != kLeftFoot &&
        b != kRightFoot && pose.p_WB[b].z() < height + kOnFeet)
      return false;
  return true;
}

List<Step> steps_of(const Character& character, const PerFrame<BodyPoses>& poses) {
  List<Step> steps;
  SolePositions next = sole_positions(character, poses[0]);
  for (int t = 0; t + 1 < poses.count(); ++t) {
    const SolePositions now = next;
    next = sole_positions(character, poses[t + 1]);
    int low = 0;
    for (int k = 1; k < kFootPoints; ++k)
      if (now[k].z() + next[k].z() < now[low].z() + next[low].z()) low = k;
    Step step;
    step.height = 0.5 * (now[low].z() + next[low].z());
    step.foot = is_on_feet(poses[t], step.height) ? low / kPointsPerFoot : -1;
    step.moved = poses[t + 1].p_WB[0] - poses[t].p_WB[0];
    step.walked = step.moved - (next[low] - now[low]);
    step.moved.z() = step.walked.z() = 0.0;
    steps.push_back(step);
  }
  return steps;
}

/// The foot that touches the floor in each step; -1: none. What is low among the frames around is on it.
List<int> feet_on_floor(const List<Step>& steps, double fps) {
  const int reach = static_cast<int>(kAround * fps);
  List<int> feet;
  for (int t = 0; t < steps.count(); ++t) {
    double low = steps[t].height;
    for (int s = std::max(0, t - reach); s <= std::min(t + reach, steps.count() - 1); ++s)
      low = std::min(low, steps[s].height);
    feet.push_back(steps[t].height < low + kContact ? steps[t].foot : -1);
  }
  return feet;
}

}  // namespace

std::optional<TravelContradiction> travel_contradiction(const Character& character,
                                                        const PerFrame<BodyPoses>& poses, double fps) {
  const List<Step> steps = steps_of(character, poses);
  const List<int> feet = feet_on_floor(steps, fps);
  const int frames = std::max(1, static_cast<int>(kStretch * fps));
  double walked_squares = 0.0, moved_along = 0.0, differences = 0.0, way = 0.0;
  int stretches = 0;
  for (int t = 0; t + frames <= steps.count(); ++t) {
    Vector3d walked = Vector3d::Zero(), moved = Vector3d::Zero();
    bool one_foot = feet[t] >= 0;
    for (int s = t; s < t + frames; ++s) {
      one_foot = one_foot && feet[s] == feet[t];
      walked += steps[s].walked;
      moved += steps[s].moved;
    }
    if (!one_foot || walked.norm() < kWalking * frames / fps) continue;
    ++stretches;
    way += walked.norm() / frames;
    walked_squares += walked.squaredNorm();
    moved_along += walked.dot(moved);
    differences += (walked - moved).squaredNorm();
  }
  if (stretches < kFewestStretches || way < kShortest || differences < kDiffers * kDiffers * walked_squares)
    return std::nullopt;
  std::vector<double> slides;
  for (int t = 0; t < steps.count(); ++t)
    if (feet[t] >= 0) slides.push_back((steps[t].moved - steps[t].walked).norm());
  const double slide = median(slides), walked = std::sqrt(walked_squares / stretches) / frames;
  if (slide < kSlides * walked) return std::nullopt;
  return TravelContradiction{kMm * slide, moved_along / walked_squares};
}

}  // namespace mimicx::motion
