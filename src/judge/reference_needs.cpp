#include "judge/reference_needs.h"

#include <algorithm>

#include "audit/pose_verdict.h"
#include "core/number_text.h"

namespace mimicx::judge {
namespace {

/// Summary of the assistance over a stretch of frames.
struct Total {
  double mean = 0.0, largest = 0.0, mean_moment = 0.0, largest_moment = 0.0;  ///< N, N·m
  int worst = 0;                                                              ///< frame of the largest force
};

Total total_of(const PerFrame<Vector6d>& assistance, int first, int last) {
  Total total;
  const double n = last - first + 1;
  total.worst = first;
  for (int t = first; t <= last; ++t) {
    const double moment = assistance[t].head<3>().norm(), force = assistance[t].tail<3>().norm();
    total.mean += force / n;
    total.mean_moment += moment / n;
    total.largest_moment = std::max(total.largest_moment, moment);
    if (force <= total.largest) continue;
    total.largest = force;
    total.worst = t;
  }
  return total;
}

}  // namespace

audit::PoseNeeds needs_of(const motion::Reference& reference, const physics::SimulationConfig& simulation) {
  if (reference.size() < 3) return {.fps = reference.fps, .frames = {}};
  return audit::needs_of_poses(reference.character, reference.poses, reference.fps,
                               {.friction = simulation.friction, .gravity = simulation.gravity},
                               reference.scene);
}

NamedValues assistance_values(const PerFrame<Vector6d>& assistance, double mass) {
  if (assistance.empty()) return {};
  const Total total = total_of(assistance, 0, assistance.count() - 1);
  return {{"help_frames", assistance.count()},           {"help_force_mean_N", total.mean},
          {"help_force_max_N", total.largest},           {"help_accel_mean_m_s2", total.mean / mass},
          {"help_accel_max_m_s2", total.largest / mass}, {"help_moment_mean_Nm", total.mean_moment},
          {"help_moment_max_Nm", total.largest_moment},  {"help_worst_frame", total.worst}};
}

std::string assistance_in_words(const PerFrame<Vector6d>& assistance, double mass, int first, int last) {
  last = std::min(last, assistance.count() - 1);
  if (first > last) return "";
  const Total total = total_of(assistance, first, last);
  return formatted(
      "with assistive forces the body passes frames %d-%d: at most %.0f N (%.1f m/s2) at frame %d and %.0f N "
      "(%.1f m/s2) on average push the pelvis, at most %.0f N m turn it",
      first, last, total.largest, total.largest / mass, total.worst, total.mean, total.mean / mass,
      total.largest_moment);
}

record::FrameFeasibility frame_feasibility(const audit::PoseNeeds& needs,
                                           const PerFrame<Vector6d>& assistance) {
  record::FrameFeasibility all;
  all.mass = needs.mass;
  for (const audit::PoseNeed& need : needs.frames) {
    Vector6d& wrench = all.need.emplace_back();
    wrench.head<3>() = need.moment;
    wrench.tail<3>() = need.force;
    all.wrong.emplace_back(audit::name_of(audit::wrong_with(need, needs.weight)));
  }
  all.assistance = assistance;
  return all;
}

}  // namespace mimicx::judge
