#include "audit/pose_verdict.h"

#include <algorithm>

#include "character/body_words.h"
#include "core/elementary.h"
#include "core/number_text.h"
#include "core/units.h"

namespace mimicx::audit {
namespace {

/// Sums over the frames.
struct Totals {
  double force = 0.0, moment = 0.0, largest_force = 0.0, largest_moment = 0.0, torque = 0.0,
         lowest = HUGE_VAL, in_box = 0.0;
  int worst_frame = 0, infeasible = 0, over_torque = 0;
  double worst = 0.0;  ///< force and moment per metre of the worst frame, N
  Array<int, kWrongs> wrong{};
  PerBody<int> over{};  ///< frames in which a joint is over its bound
};

Totals totals_of(const PoseNeeds& needs) {
  Totals sum;
  for (int t = 0; t < needs.frames.count(); ++t) {
    const PoseNeed& need = needs.frames[t];
    const double force = need.force.norm(), moment = need.moment.norm();
    sum.force += force;
    sum.moment += moment;
    sum.largest_force = std::max(sum.largest_force, force);
    sum.largest_moment = std::max(sum.largest_moment, moment);
    sum.lowest = std::min(sum.lowest, need.lowest);
    sum.in_box = std::max(sum.in_box, need.in_box);
    if (hypot(force, moment) > sum.worst) {
      sum.worst = hypot(force, moment);
      sum.worst_frame = t;
    }
    const Wrong wrong = wrong_with(need, needs.weight);
    ++sum.wrong[static_cast<int>(wrong)];
    sum.infeasible += wrong != Wrong::kNothing;
    bool over = false;
    for (int b = 1; b < kBodies; ++b) {
      sum.torque = std::max(sum.torque, need.torque[b]);
      sum.over[b] += need.torque[b] > 1.0;
      over = over || need.torque[b] > 1.0;
    }
    sum.over_torque += over;
  }
  return sum;
}

std::string joints_over(const PerBody<int>& over) {
  std::string text;
  for (int b = 1; b < kBodies; ++b)
    if (over[b] > 0)
      text += formatted("%s%s:%d", text.empty() ? "" : " ", std::string(kBodyNames[b]).c_str(), over[b]);
  return text;
}

std::string over_in_words(const PerBody<int>& over) {
  std::string text;
  for (int b = 1; b < kBodies; ++b)
    if (over[b] > 0) text += (text.empty() ? "" : ", ") + body_in_words(b) + ' ' + std::to_string(over[b]);
  return text;
}

std::string words_for(const PoseNeeds& needs, const Totals& sum, const Stretch& longest) {
  if (longest.wrong == Wrong::kNothing)
    return formatted("feasible: at most %.0f N and %.0f N m from outside", sum.largest_force,
                     sum.largest_moment);
  const double share = 100.0 * sum.infeasible / needs.frames.count();
  return in_words(longest) + formatted("; %.0f %% of the frames are infeasible", share);
}

}  // namespace

std::string_view name_of(Wrong wrong) {
  constexpr Array<std::string_view, kWrongs> kNames = {"feasible", "hovers", "pulled", "drifts",
                                                       "turns",    "slips",  "tips",   "sunk"};
  return kNames[static_cast<int>(wrong)];
}

Wrong wrong_with(const PoseNeed& need, double weight) {
  const double force = need.force.norm(), moment = need.moment.norm();
  if (!(std::max(force, moment) > kTooMuch * weight))
    return std::max(-need.lowest, need.in_box) > kTooDeep ? Wrong::kSunk : Wrong::kNothing;
  const double up = need.force.z(), sideways = need.force.head<2>().norm();
  const double largest = std::max({up, -up, sideways, moment});
  if (largest == up) return Wrong::kHovers;
  if (largest == -up) return Wrong::kPulled;
  if (largest == sideways) return need.points == 0 ? Wrong::kDrifts : Wrong::kSlips;
  return need.points == 0 ? Wrong::kTurns : Wrong::kTipsOver;
}

std::vector<Stretch> infeasible_stretches(const PoseNeeds& needs) {
  std::vector<Stretch> stretches;
  Array<int, kWrongs> count{};
  for (int t = 0; t < needs.frames.count(); ++t) {
    const PoseNeed& need = needs.frames[t];
    const Wrong wrong = wrong_with(need, needs.weight);
    if (wrong == Wrong::kNothing) continue;
    if (stretches.empty() || stretches.back().last + 1 < t) {
      stretches.push_back({.first = t, .last = t});
      count.fill(0);
    }
    Stretch& stretch = stretches.back();
    stretch.last = t;
    stretch.force = std::max(stretch.force, need.force.norm());
    stretch.moment = std::max(stretch.moment, need.moment.norm());
    stretch.depth = std::max(stretch.depth, -need.lowest);
    stretch.in_box = std::max(stretch.in_box, need.in_box);
    ++count[static_cast<int>(wrong)];
    stretch.wrong = static_cast<Wrong>(std::max_element(count.begin(), count.end()) - count.begin());
  }
  return stretches;
}

std::string in_words(const Stretch& stretch) {
  const std::string frames = stretch.first == stretch.last
                                 ? formatted("frame %d: ", stretch.first)
                                 : formatted("frames %d-%d: ", stretch.first, stretch.last);
  switch (stretch.wrong) {
    case Wrong::kHovers:
      return frames + formatted("the body hovers; %.0f N would have to hold it", stretch.force);
    case Wrong::kPulled:
      return frames +
             formatted("the body sinks faster than it falls; %.0f N would have to pull it", stretch.force);
    case Wrong::kDrifts:
      return frames + formatted("the body drifts in the air; %.0f N would have to push it", stretch.force);
    case Wrong::kTurns:
      return frames + formatted("the body turns in the air; %.0f N m would have to turn it", stretch.moment);
    case Wrong::kSlips:
      return frames + formatted("the body would slip; %.0f N would have to push it", stretch.force);
    case Wrong::kTipsOver:
      return frames + formatted("the body tips over; %.0f N m would have to hold it", stretch.moment);
    case Wrong::kSunk:
      return frames + formatted("the body is %.0f mm in %s", kMm * std::max(stretch.depth, stretch.in_box),
                                stretch.in_box > stretch.depth ? "a box" : "the floor");
    default:
      return frames + "nothing is wrong";
  }
}

PoseVerdict verdict_on(const PoseNeeds& needs) {
  const Totals sum = totals_of(needs);
  const double n = std::max(1, needs.frames.count());
  PoseVerdict verdict;
  for (const Stretch& stretch : infeasible_stretches(needs))
    if (verdict.longest.wrong == Wrong::kNothing || stretch.frames() > verdict.longest.frames())
      verdict.longest = stretch;
  const Stretch& longest = verdict.longest;
  const bool any = longest.wrong != Wrong::kNothing;
  verdict.values = {{"frames", needs.frames.count()},
                    {"fps", needs.fps},
                    {"weight_N", needs.weight},
                    {"force_mean_N", sum.force / n},
                    {"force_max_N", sum.largest_force},
                    {"accel_mean_m_s2", sum.force / n / needs.mass},
                    {"accel_max_m_s2", sum.largest_force / needs.mass},
                    {"moment_mean_Nm", sum.moment / n},
                    {"moment_max_Nm", sum.largest_moment},
                    {"worst_frame", sum.worst_frame},
                    {"infeasible_share", sum.infeasible / n}};
  for (int k = 1; k < kWrongs; ++k)
    verdict.values.emplace_back(std::string(name_of(static_cast<Wrong>(k))) + "_share", sum.wrong[k] / n);
  append(verdict.values, {{"longest_s", any ? longest.frames() / needs.fps : 0.0},
                          {"longest_first", any ? 1.0 * longest.first : NAN},
                          {"longest_last", any ? 1.0 * longest.last : NAN},
                          {"over_torque_share", sum.over_torque / n},
                          {"torque_max_share", sum.torque},
                          {"lowest_mm", kMm * sum.lowest},
                          {"in_box_mm", kMm * sum.in_box}});
  verdict.joints_over = joints_over(sum.over);
  verdict.over_in_words = over_in_words(sum.over);
  verdict.words = words_for(needs, sum, longest);
  return verdict;
}

}  // namespace mimicx::audit
