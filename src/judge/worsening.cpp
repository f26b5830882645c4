#include "judge/worsening.h"

#include <algorithm>
#include <cmath>

#include "audit/pose_verdict.h"
#include "core/number_text.h"
#include "core/units.h"
#include "judge/force_metrics.h"
#include "judge/headline.h"

namespace mimicx::judge {
namespace {

constexpr double kShareOfExcess = 0.25;  ///< of the largest: a frame with this much is named
constexpr double kShareOfFault = 0.5;    ///< of the result's fault: the reference has it, too
constexpr int kGap = 3;                  ///< frames between two stretches that are named as one
constexpr int kMostStretches = 3;
constexpr int kNearby = 2;               ///< frames around a stretch in which its cause may be
constexpr double kCompliantFloor = 5.0;  ///< mm that the simulated floor may give way under load
constexpr double kLandingLoad = 0.05;    ///< of the weight

/// A fault of one motion, frame by frame; 0 where it has none.
using Curve = PerFrame<double>;

/// One of the three motions.
struct Faults {
  motion::MotionSamples samples;
  Curve slip;  ///< mm a frame
};

Curve curve_of(const audit::Slip& slip) {
  Curve curve = slip.speed;
  for (double& value : curve) value = std::isfinite(value) ? value : 0.0;
  return curve;
}

motion::MotionSamples slice(const motion::MotionSamples& all, int first, int frames) {
  motion::MotionSamples some;
  some.fps = all.fps;
  some.scene = all.scene;
  for (int t = first; t < first + frames; ++t) {
    some.joints.push_back(all.joints[t]);
    some.surface.push_back(all.surface[t]);
    some.self_depth.push_back(all.self_depth[static_cast<std::size_t>(t)]);
  }
  return some;
}

/// Frames that the formula of a measure needs.
int frames_of(const Headline& h) {
  return h.value == &motion::Metrics::jitter ? 4 : h.value == &motion::Metrics::fs_gt ? 2 : 1;
}

Curve curve_of(const Headline& h, const Faults& faults, const motion::MotionSamples& reference) {
  if (h.value == &motion::Metrics::slip) return faults.slip;
  const int frames = faults.samples.frames(), needed = frames_of(h);
  Curve curve(frames, 0.0);
  for (int t = 0; t + needed <= frames; ++t) {
    const motion::MotionSamples truth = slice(reference, t, needed);
    const motion::Metrics m = motion::evaluate_motion(slice(faults.samples, t, needed), &truth);
    const double value = (m.*h.value).value;
    curve[t + needed / 2] = std::isfinite(value) ? h.scale * value : 0.0;
  }
  return curve;
}

struct Frames {
  int first = 0, last = 0;
  double excess = 0.0;
};

/// The stretches with the most excess of a over b, in the order of time.
std::vector<Frames> worst_stretches(const Curve& a, const Curve& b) {
  double most = 0.0;
  for (int t = 0; t < a.count(); ++t) most = std::max(most, a[t] - b[t]);
  std::vector<Frames> stretches;
  for (int t = 0; t < a.count() && most > 0.0; ++t) {
    if (a[t] - b[t] < kShareOfExcess * most) continue;
    if (stretches.empty() || t > stretches.back().last + kGap) stretches.push_back({t, t, 0.0});
    stretches.back().last = t;
    stretches.back().excess += a[t] - b[t];
  }
  std::stable_sort(stretches.begin(), stretches.end(),
                   [](const Frames& x, const Frames& y) { return x.excess > y.excess; });
  if (stretches.size() > kMostStretches) stretches.resize(kMostStretches);
  std::sort(stretches.begin(), stretches.end(),
            [](const Frames& x, const Frames& y) { return x.first < y.first; });
  return stretches;
}

double sum_over(const std::vector<Frames>& stretches, const Curve& curve) {
  double sum = 0.0;
  for (const Frames& s : stretches)
    for (int t = s.first; t <= s.last; ++t) sum += curve[t];
  return sum;
}

/// The first infeasible stretch of the reference that is near.
std::string infeasible_near(const std::vector<Frames>& stretches, const audit::PoseNeeds& needs) {
  for (const audit::Stretch& wrong : audit::infeasible_stretches(needs))
    for (const Frames& s : stretches)
      if (wrong.last >= s.first - kNearby && wrong.first <= s.last + kNearby)
        return "its reference is not feasible: " + audit::in_words(wrong);
  return "";
}

/// Whether the floor begins to push a foot in or near the stretches.
bool lands(const std::vector<Frames>& stretches, const audit::FloorWrenches& ground, double weight) {
  for (const Frames& s : stretches)
    for (int t = std::max(1, s.first - kNearby); t <= std::min(ground.count() - 1, s.last + kNearby); ++t)
      for (const int foot : {kLeftAnkle, kRightAnkle, kLeftFoot, kRightFoot})
        if (ground[t - 1][foot][5] < kLandingLoad * weight && ground[t][foot][5] >= kLandingLoad * weight)
          return true;
  return false;
}

/// Whether the input is over the floor, on average.
bool hangs(const std::vector<Frames>& stretches, const motion::MotionSamples& input) {
  double height = 0.0, frames = 0.0;
  for (const Frames& s : stretches)
    for (int t = s.first; t <= s.last; ++t, ++frames)
      height += motion::lowest_height(input.surface[t], input.scene);
  return height > motion::kContactHeight * frames;
}

/// Whether the result is no deeper than the simulated floor gives way. @param result  depths, mm
bool gives_way(const Curve& result) {
  return *std::max_element(result.begin(), result.end()) <= kCompliantFloor;
}

/// All that explains a fault.
struct Evidence {
  const motion::MotionSamples& input;
  const motion::Reference& reference;
  const audit::PoseNeeds& needs;
  const audit::FloorWrenches& ground;  ///< of the result
  double weight;
};

std::string special_cause(const Headline& h, const std::vector<Frames>& stretches, const Curve& result,
                          const Evidence& evidence) {
  if (h.value == &motion::Metrics::slip) {
    const Curve carried = curve_of(audit::slip_of(evidence.reference.poses, evidence.ground, evidence.weight,
                                                  evidence.reference.fps, evidence.reference.scene));
    if (sum_over(stretches, carried) >= kShareOfFault * sum_over(stretches, result))
      return "its reference moves the foot that carries the body";
  }
  if (h.value == &motion::Metrics::gp)
    return gives_way(result) ? "the simulated floor gives way under load"
                             : "limbs reach below it between the points that it carries";
  if (h.value == &motion::Metrics::jitter && lands(stretches, evidence.ground, evidence.weight))
    return "a foot lands";
  return "its reference does not";
}

std::string cause(const Headline& h, const std::vector<Frames>& stretches, const Curve& result,
                  const Curve& reference, const Evidence& evidence) {
  if (h.value == &motion::Metrics::gp && gives_way(result) && hangs(stretches, evidence.input))
    return "the input hangs over the floor";
  if (sum_over(stretches, reference) >= kShareOfFault * sum_over(stretches, result))
    return std::string("its reference ") + h.verb + ", too";
  const std::string infeasible = infeasible_near(stretches, evidence.needs);
  return infeasible.empty() ? special_cause(h, stretches, result, evidence) : infeasible;
}

std::string printed(const Headline& h, double value) {
  return formatted("%.*f", h.decimals, h.scale * value);
}

/// Whether the printed number is larger than the input's.
bool is_worse(const Headline& h, double before, double after) {
  if (!std::isfinite(before) || !(h.scale * after >= h.visible)) return false;
  return after > before && printed(h, after) != printed(h, before);
}

}  // namespace

std::vector<record::Worsening> worsenings(const Origin& origin, const rl::tracking::TrackingRollout& rollout,
                                          const NamedValues& metrics) {
  std::vector<record::Worsening> worse;
  const motion::Reference& reference = origin.reference;
  const bool any = std::any_of(kHeadlines.begin(), kHeadlines.end(), [&](const Headline& h) {
    return is_worse(h, value_of(origin.input_scores.values, h.metric), value_of(metrics, h.metric));
  });
  if (!any || origin.input_scores.slip.speed.count() != reference.size() ||
      rollout.poses.size() != reference.frames.size())
    return worse;

  const audit::FloorWrenches ground = ground_of(rollout);
  motion::Metrics unused;
  const Character& body = reference.character;
  const PerFrame<BodyPoses> poses = poses_of(body, rollout);
  const Faults input{samples_at(origin.input, reference.fps), curve_of(origin.input_scores.slip)},
      asked{motion::sample_motion(body, reference.poses, reference.fps, reference.scene),
            curve_of(
                judge_poses(body, reference.poses, reference.fps, reference.scene, rollout.gravity, unused))},
      made{motion::sample_motion(body, poses, reference.fps, reference.scene),
           curve_of(
               judge_forces({body, poses, ground, reference.fps, reference.scene, rollout.gravity}, unused))};
  const Evidence evidence{input.samples, reference, origin.needs, ground,
                          rollout.gravity * reference.character.total_mass()};
  for (const Headline& h : kHeadlines) {
    const double before = value_of(origin.input_scores.values, h.metric), after = value_of(metrics, h.metric);
    if (!is_worse(h, before, after)) continue;
    const Curve result = curve_of(h, made, asked.samples);
    const std::vector<Frames> stretches = worst_stretches(result, curve_of(h, input, asked.samples));
    record::Worsening& one = worse.emplace_back();
    one.measure = h.name;
    one.numbers = printed(h, before) + " -> " + printed(h, after) + " " + h.unit;
    one.why = cause(h, stretches, result, curve_of(h, asked, asked.samples), evidence);
    for (const Frames& s : stretches) one.frames.push_back({s.first, s.last});
  }
  return worse;
}

}  // namespace mimicx::judge
