#include "audit/audit_summary.h"

#include <algorithm>
#include <cmath>

#include "core/number_text.h"
#include "core/units.h"

namespace mimicx::audit {
namespace {

/// Limits of an audit; forces in parts of the weight, moments in metres (N·m per N of weight). They also
/// apply to the gap between required and exported joint torques.
struct Limits {
  double mean_force, mean_moment, max_force, max_moment;
};
/// Where they come from: docs/physics.md §9.
Limits limits_of(Evidence evidence) {
  switch (evidence) {
    case Evidence::kSteps:
      return {1e-3, 1e-3, 0.05, 0.05};
    case Evidence::kReplayedSteps:
      return {1e-9, 1e-9, 1e-9, 1e-9};
    case Evidence::kFrames:
      return {0.02, 0.02, 0.2, 0.2};
    default:
      return {0.02, 0.02, HUGE_VAL, HUGE_VAL};
  }
}
constexpr double kTorqueRounding = 1e-5;  ///< relative, of float32
constexpr double kMostTravel = 1.2;       ///< parts of (12): its derivation leaves out an eighth
/// Share of the normal impulse, which the contact law does not reach (docs/physics.md §4); likewise of pull
/// and of force in the air.
constexpr double kMostBeyondCone = 0.1;
constexpr double kConeViolation = 0.01;  ///< friction beyond the cone and pull, parts of the weight

struct Extreme {
  double sum = 0.0, largest = 0.0;
  int where = 0;
  void add(double value, int index) {
    sum += value;
    if (std::isnan(largest) || value <= largest) return;  // NaN counts as the largest
    largest = value;
    where = index;
  }
};

/// Distance of the poses from the floor.
NamedValues floor_summary(const Audit& audit) {
  double untouched = 0.0, low = HUGE_VAL, high = -HUGE_VAL;
  for (const AuditRow& row : audit.rows) {
    untouched += std::abs(row.lowest) > kFloorReach;
    low = std::min(low, row.lowest);
    high = std::max(high, row.lowest);
  }
  return {{"untouched_percent", 100.0 * untouched / static_cast<double>(audit.rows.size())},
          {"lowest_min_mm", kMm * low},
          {"lowest_max_mm", kMm * high}};
}

/// What the forces are like.
NamedValues force_summary(const Audit& audit) {
  Extreme gap, share, power, travel, replay;
  double normal = 0.0, pull = 0.0, cone = 0.0, air = 0.0, positive = 0.0, total = 0.0;
  int over_bound = 0, beyond_cone = 0;
  for (const AuditRow& row : audit.rows) {
    gap.add(row.torque_gap, row.index);
    share.add(row.torque_share, row.index);
    power.add(row.total, row.index);
    travel.add(row.travel, row.index);
    replay.add(row.replay_gap, row.index);
    normal += row.normal;
    pull += row.pull;
    cone += row.beyond_cone;
    air += row.in_air;
    positive += row.positive;
    total += row.total;
    over_bound += row.torque_share > 1.0 + kTorqueRounding;
    beyond_cone += row.beyond_cone + row.pull > kConeViolation * audit.weight;
  }
  const double n = std::max<double>(static_cast<double>(audit.rows.size()), 1.0);
  const double hundred = 100.0 / std::max(normal, 1e-9);
  NamedValues values = {
      {"torque_gap_mean_Nm", gap.sum / n},        {"torque_gap_max_Nm", gap.largest},
      {"torque_worst_share", share.largest},      {"torque_violations", over_bound},
      {"beyond_cone_percent", hundred * cone},    {"pull_percent", hundred * pull},
      {"in_air_percent", hundred * air},          {"cone_violations", beyond_cone},
      {"travel_worst_share", travel.largest},     {"power_max_W", power.largest},
      {"work_positive_J", positive / audit.rate}, {"work_negative_J", (positive - total) / audit.rate}};
  if (audit.evidence != Evidence::kReplayedSteps) return values;
  values.emplace_back("replay_gap_mean_N", replay.sum / n);
  values.emplace_back("replay_gap_max_N", replay.largest);
  return values;
}

std::string percent(double share) { return formatted("%.3g %%", 100.0 * share); }

/// The distance from the floor of a motion whose poses fail, in words.
std::string where_it_stands(const NamedValues& values) {
  return formatted("no point within 1 cm of the floor in %.0f %% of the frames; lowest point %.0f to %.0f mm",
                   value_of(values, "untouched_percent"), value_of(values, "lowest_min_mm"),
                   value_of(values, "lowest_max_mm"));
}

}  // namespace

std::vector<std::string> failures_of(const Audit& audit) {
  if (audit.rows.empty()) return {"no two frames: nothing moves that forces could explain"};
  std::vector<std::string> failures;
  const Limits limits = limits_of(audit.evidence);
  const NamedValues values = summary_of(audit);
  const auto check = [&](const std::string& what, const std::string& name, double limit, const char* unit) {
    const double value = value_of(values, name);
    if (value <= limit * audit.weight) return;
    failures.push_back(formatted("%s %.3g %s, %s of the weight%s; at most %s", what.c_str(), value, unit,
                                 percent(value / audit.weight).c_str(), unit[1] == '\0' ? "" : " times 1 m",
                                 percent(limit).c_str()));
  };
  check("mean unexplained root force", "root_force_mean_N", limits.mean_force, "N");
  check("mean unexplained root moment", "root_moment_mean_Nm", limits.mean_moment, "N·m");
  check("largest unexplained root force", "root_force_max_N", limits.max_force, "N");
  check("largest unexplained root moment", "root_moment_max_Nm", limits.max_moment, "N·m");
  if (audit.evidence == Evidence::kPosesAlone) {
    if (!failures.empty() && value_of(values, "untouched_percent") > 0.0)
      failures.push_back(where_it_stands(values));
    return failures;
  }
  check("mean gap between required and exported torques", "torque_gap_mean_Nm", limits.mean_moment, "N·m");
  check("largest gap between required and exported torques", "torque_gap_max_Nm", limits.max_moment, "N·m");
  if (!(value_of(values, "travel_worst_share") <= kMostTravel))
    failures.push_back("velocities that do not fit the positions");
  const double bound = value_of(values, "torque_worst_share");
  if (!(bound <= 1.0 + kTorqueRounding))
    failures.push_back("a joint torque of " + percent(bound) + " of its bound");
  for (const auto& [what, name] : {std::pair{"friction beyond its cone", "beyond_cone_percent"},
                                   std::pair{"pull of the floor", "pull_percent"},
                                   std::pair{"floor forces on bodies in the air", "in_air_percent"}}) {
    const double share = value_of(values, name) / 100.0;
    if (!(share <= kMostBeyondCone))
      failures.push_back(std::string(what) + ": " + percent(share) + " of the normal impulse");
  }
  return failures;
}

NamedValues summary_of(const Audit& audit) {
  Extreme force, moment;
  for (const AuditRow& row : audit.rows) {
    force.add(row.root.tail<3>().norm(), row.index);
    moment.add(row.root.head<3>().norm(), row.index);
  }
  const double n = std::max<double>(static_cast<double>(audit.rows.size()), 1.0);
  NamedValues values = {{"root_force_mean_N", force.sum / n},   {"root_force_max_N", force.largest},
                        {"root_force_worst", force.where},      {"root_moment_mean_Nm", moment.sum / n},
                        {"root_moment_max_Nm", moment.largest}, {"root_moment_worst", moment.where}};
  const bool poses_alone = audit.evidence == Evidence::kPosesAlone;
  append(values, poses_alone ? floor_summary(audit) : force_summary(audit));
  return values;
}

}  // namespace mimicx::audit
