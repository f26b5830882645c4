#include "import/evidence/translation_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/elementary.h"
#include "core/quantile.h"
#include "import/plausibility.h"

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

/// Height of the lowest points over 0, m, along the axis along which the body stands.
double floor_of(const motion::Clip& clip) {
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  Vector3d along = Vector3d::Zero();
  for (const BodyPoses& pose : poses)
    along += pose.p_WB[kNeck] - 0.5 * (pose.p_WB[kLeftAnkle] + pose.p_WB[kRightAnkle]);
  int axis = 0;
  along.cwiseAbs().maxCoeff(&axis);
  const double sign = along[axis] < 0.0 ? -1.0 : 1.0;
  std::vector<double> lowest;
  for (const BodyPoses& pose : poses) {
    double low = sign * pose.p_WB[0][axis];
    for (const Vector3d& p : pose.p_WB) low = std::min(low, sign * p[axis]);
    lowest.push_back(low);
  }
  return finite_quantile(lowest, 0.05);
}

double costs_of(const motion::Clip& clip, const TransUnit& unit) {
  const motion::Clip other = scaled(clip, unit.metres);
  const double slide = support_speed(other), floor = std::abs(floor_of(other));
  return unit.rare + log((slide + kStill) / kStill) +
         std::min(log((floor + kAtZero) / kAtZero), kMostOfFloor) + (floor > kFar ? kOfFar : 0.0);
}

}  // namespace

TranslationUnit decide_translation_unit(const motion::Clip& clip) {
  std::array<double, kTransUnits.size()> costs{};
  for (std::size_t i = 0; i < kTransUnits.size(); ++i) costs[i] = costs_of(clip, kTransUnits[i]);
  std::size_t best = 0;
  for (std::size_t i = 1; i < kTransUnits.size(); ++i)
    if (costs[i] < costs[best]) best = i;
  TranslationUnit out;
  const bool other = costs[best] + kMostLead < costs[0];
  const std::size_t chosen = other ? best : 0;
  out.name = kTransUnits[chosen].name;
  out.metres = kTransUnits[chosen].metres;
  out.support_speed = support_speed(scaled(clip, out.metres));
  std::size_t next = chosen == 0 ? 1 : 0;
  for (std::size_t i = 0; i < kTransUnits.size(); ++i)
    if (i != chosen && costs[i] < costs[next]) next = i;
  if (costs[next] < costs[chosen] + 0.5) {
    out.near = kTransUnits[next].name;
    out.near_metres = kTransUnits[next].metres;
  }
  return out;
}

}  // namespace mimicx::import
