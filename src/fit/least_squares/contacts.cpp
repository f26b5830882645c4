#include "fit/least_squares/contacts.h"

#include <algorithm>
#include <cmath>

#include "core/quantile.h"
#include "motion/prepare/stance.h"

namespace mimicx::fit {
namespace {

constexpr double kSpeed = 0.3;                             ///< m/s over five frames at 30 fps
constexpr double kHeight = 0.03, kUnsettledHeight = 0.05;  ///< m
constexpr double kLowShare = 0.1;
constexpr double kSpeedWindow = 2.0 / 30.0;  ///< s to either side
constexpr double kLevel = 0.5;               ///< vertical part of a sole's normal

/// Low percentile of the height of a foot's lowest point over the ground, m. @param first  the foot's first
/// point
double floor_under(const PerFrame<FootPositions>& feet, int first, const Scene& scene) {
  std::vector<double> lowest;
  for (const FootPositions& p : feet) {
    const Vector3d middle = sole_middle(p, first);
    double z = scene.clearance(p[first], middle);
    for (int i = first; i < first + kPointsPerFoot; ++i) z = std::min(z, scene.clearance(p[i], middle));
    lowest.push_back(z);
  }
  return ranked(lowest, static_cast<int>(kLowShare * static_cast<double>(lowest.size())));
}

}  // namespace

Vector3d sole_middle(const FootPositions& feet, int point) {
  const int first = point - point % kPointsPerFoot;
  Vector3d sum = Vector3d::Zero();
  for (int i = first; i < first + kPointsPerFoot; ++i) sum += feet[i];
  return sum / kPointsPerFoot;
}

Contacts find_contacts(const PerFrame<FootPositions>& feet, double fps, const Scene& scene, bool settled) {
  Contacts contacts(feet.size());
  const int last = feet.count() - 1;
  const int window = static_cast<int>(std::max(1.0, std::round(kSpeedWindow * fps)));
  for (const int first : {0, kPointsPerFoot}) {
    const double ceiling = settled ? kHeight : floor_under(feet, first, scene) + kUnsettledHeight;
    for (int t = 0; t <= last; ++t) {
      const int before = std::max(t - window, 0), after = std::min(t + window, last);
      const Vector3d middle = sole_middle(feet[t], first);
      for (int i = first; i < first + kPointsPerFoot; ++i) {
        const double speed = (feet[after][i] - feet[before][i]).norm() * fps / (after - before);
        contacts[t][i] = scene.clearance(feet[t][i], middle) < ceiling && speed < kSpeed;
      }
    }
  }
  const PerFrame<bool> carried(feet.size(), true);  // a hop of so few frames is 2 cm high
  motion::stand_through_jumps(feet, carried, fps, 2 * window + 1, scene, contacts);
  return contacts;
}

void keep_level_soles(const FitProblem& problem, const PerFrame<FrameKinematics>& motion,
                      Contacts& contacts) {
  for (int t = 0; t < contacts.count(); ++t)
    for (int i = 0; i < kFootPoints; ++i)
      if (motion[t].R[problem.foot_points[i].body](2, 1) < kLevel) contacts[t][i] = false;
}

}  // namespace mimicx::fit
