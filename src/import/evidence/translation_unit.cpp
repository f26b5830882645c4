#include "import/evidence/translation_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/elementary.h"
#include "core/quantile.h"
#include "import/evidence/up_axis.h"
#include "import/landmarks.h"
#include "import/plausibility.h"
#include "import/world_transform.h"

namespace mimicx::import {
namespace {

struct TransUnit {
  const char* name;
  double metres;
  double rare;  ///< costs
};
constexpr std::array<TransUnit, 6> kTransUnits = {{{"metres", 1.0, 0.0},
                                                   {"centimetres", 0.01, 1.4},
                                                   {"millimetres", 0.001, 1.4},
                                                   {"decimetres", 0.1, 1.8},
                                                   {"inches", 0.0254, 1.8},
                                                   {"feet", 0.3048, 1.8}}};
constexpr double kStill = 0.1;        ///< m/s, of a foot that is planted
constexpr double kAtZero = 0.1;       ///< m, of a floor that is at 0
constexpr double kMostOfFloor = 2.2;  ///< costs of a floor elsewhere
constexpr double kFar = 20.0, kOfFar = 2.0;
constexpr double kMostLead = 1.0;  ///< by which another unit must be better than metres

motion::Clip scaled(const motion::Clip& clip, double metres) {
  motion::Clip out = clip;
  for (Vector3d& trans : out.trans) trans *= metres;
  return out;
}

/// Height of the lowest points over 0, m, along the axis that is then likeliest to be up.
double floor_of(const PerFrame<BodyPoses>& poses) {
  const char axis = decide_up(landmarks_of(poses), std::nullopt, 'z').axis;
  const Vector3d up = rotation_to_z_up(axis).conjugate() * Vector3d::UnitZ();
  std::vector<double> lowest;
  for (const BodyPoses& pose : poses) {
    double low = pose.p_WB[0].dot(up);
    for (const Vector3d& p : pose.p_WB) low = std::min(low, p.dot(up));
    lowest.push_back(low);
  }
  return finite_quantile(lowest, 0.05);
}

/// What speaks against a unit, and the clip's support speed in it, m/s.
struct UnitCosts {
  double costs = 0, support_speed = 0;
};
UnitCosts costs_of(const motion::Clip& clip, const TransUnit& unit) {
  const PerFrame<BodyPoses> poses = motion::poses_of(scaled(clip, unit.metres));
  const double slide = support_speed(poses, clip.fps), floor = std::abs(floor_of(poses));
  return {unit.rare + log((slide + kStill) / kStill) +
              std::min(log((floor + kAtZero) / kAtZero), kMostOfFloor) + (floor > kFar ? kOfFar : 0.0),
          slide};
}

}  // namespace

TranslationUnit decide_translation_unit(const motion::Clip& clip) {
  std::array<UnitCosts, kTransUnits.size()> found{};
  for (std::size_t i = 0; i < kTransUnits.size(); ++i) found[i] = costs_of(clip, kTransUnits[i]);
  std::size_t best = 0;
  for (std::size_t i = 1; i < kTransUnits.size(); ++i)
    if (found[i].costs < found[best].costs) best = i;
  TranslationUnit out;
  const bool other = found[best].costs + kMostLead < found[0].costs;
  const std::size_t chosen = other ? best : 0;
  out.name = kTransUnits[chosen].name;
  out.metres = kTransUnits[chosen].metres;
  out.support_speed = found[chosen].support_speed;
  std::size_t next = chosen == 0 ? 1 : 0;
  for (std::size_t i = 0; i < kTransUnits.size(); ++i)
    if (i != chosen && found[i].costs < found[next].costs) next = i;
  if (found[next].costs < found[chosen].costs + 0.5) {
    out.near = kTransUnits[next].name;
    out.near_metres = kTransUnits[next].metres;
  }
  return out;
}

}  // namespace mimicx::import
