#include "import/evidence/length_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/elementary.h"
#include "core/quantile.h"
#include "core/units.h"
#include "import/evidence/cadence.h"
#include "import/evidence/falls.h"

namespace mimicx::import {
namespace {

struct Unit {
  const char* name;
  double metres;
  double common;  ///< log-likelihood of the unit itself
};
// CMU's recordings are in inches divided by 0.45; MakeHuman's in decimetres.
constexpr std::array<Unit, 7> kUnits = {{{"metres", 1.0, 0.0},
                                         {"centimetres", 0.01, 0.0},
                                         {"millimetres", 0.001, -1.0},
                                         {"inches", 0.0254, -1.5},
                                         {"inches / 0.45", 0.0254 / 0.45, -2.0},
                                         {"decimetres", 0.1, -1.5},
                                         {"feet", 0.3048, -3.0}}};

/// Joints by whose names an exporter is known, and the unit it writes.
struct Signature {
  std::string_view part;  ///< of a joint's name
  const char* unit;
};
constexpr std::array<Signature, 3> kSignatures = {
    {{"LHipJoint", "inches / 0.45"}, {"mixamorig", "centimetres"}, {"Bip01", "inches"}}};
constexpr double kOfSignature = 1.0;

// Legs, and trunks for their legs, of adults and of a child of two years.
constexpr double kAdultLeg = 0.8, kAdultTrunk = 0.64, kChildLeg = 0.33, kChildTrunk = 0.92;
constexpr double kSpread = 0.12;    ///< of the logarithm of an adult's leg
constexpr double kFarSpread = 0.6;  ///< of what is no ordinary body
constexpr double kOrdinary = 3.0;   ///< log-likelihood by which an ordinary body is more likely
constexpr double kFits = 3.0;       ///< spreads
constexpr double kShortestLeg = 0.28, kLongestLeg = 1.3;  ///< m, of people
constexpr double kFallSpread = 0.2;                       ///< of the logarithm of the leg that a fall gives
constexpr double kWalkSpread = 0.26;                      ///< the same, of a walk

/// The usual logarithm of a leg of a body of these proportions, and its spread.
std::pair<double, double> usual_leg(double trunk_to_leg) {
  const double child = std::clamp((trunk_to_leg - kAdultTrunk) / (kChildTrunk - kAdultTrunk), 0.0, 1.0);
  return {log(kAdultLeg) + child * log(kChildLeg / kAdultLeg), kSpread * (1.0 + child)};
}

}  // namespace

UnitEvidence unit_evidence(const PerFrame<Landmarks>& poses, const Vector3d& up, double fps,
                           std::vector<std::string> names) {
  UnitEvidence evidence;
  evidence.leg = leg_length(poses);
  std::vector<double> trunks;
  for (const Landmarks& pose : poses)
    trunks.push_back(
        (pose.between(kLeftShoulder, kRightShoulder) - pose.between(kLeftHip, kRightHip)).norm());
  evidence.trunk = median(trunks);
  if (const std::vector<double> falls = falls_along(poses, up); !falls.empty())
    evidence.fall_leg = kGravity / (median(falls) * fps * fps);
  evidence.walk_leg = walking_leg(poses, up, fps);
  evidence.names = std::move(names);
  return evidence;
}

bool is_human_leg(double leg) { return leg > kShortestLeg && leg < kLongestLeg; }

UnitDecision decide_unit(const UnitEvidence& evidence) {
  const auto [usual, spread] = usual_leg(evidence.trunk / evidence.leg);
  const auto likelihood = [&, usual = usual, spread = spread](const Unit& unit) {
    const double leg = log(unit.metres * evidence.leg), off = (leg - usual) / spread,
                 far = (leg - log(kAdultLeg)) / kFarSpread;
    double sum = unit.common + std::max(-0.5 * off * off, -kOrdinary - 0.5 * far * far);
    if (evidence.fall_leg) {
      const double fall = (leg - log(*evidence.fall_leg)) / kFallSpread;
      sum += std::max(-0.5 * fall * fall, -kOrdinary);  // the frame rate may be wrong
    }
    if (evidence.walk_leg) {
      const double fast = std::max(0.0, (leg - log(*evidence.walk_leg)) / kWalkSpread);
      sum += std::max(-0.5 * fast * fast, -kOrdinary);
    }
    for (const Signature& signature : kSignatures)
      if (signature.unit == std::string_view(unit.name) &&
          std::any_of(evidence.names.begin(), evidence.names.end(), [&](const std::string& name) {
            return name.find(signature.part) != std::string::npos;
          }))
        sum += kOfSignature;
    return sum;
  };
  std::vector<std::pair<double, const Unit*>> order;
  for (const Unit& unit : kUnits) order.emplace_back(likelihood(unit), &unit);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  const auto fits = [&](const Unit& unit) { return is_human_leg(unit.metres * evidence.leg); };
  const Unit& best = *order[0].second;
  UnitDecision out;
  out.name = best.name;
  out.metres = best.metres;
  out.usual_leg = exp(usual);
  out.fits = fits(best);
  out.usual = std::abs(log(best.metres * evidence.leg) - usual) < kFits * spread;
  const auto second =
      std::find_if(order.begin() + 1, order.end(), [&](const auto& other) { return fits(*other.second); });
  if (second != order.end()) {
    out.second = second->second->name;
    out.second_metres = second->second->metres;
    out.lead = order[0].first - second->first;
  }
  return out;
}

}  // namespace mimicx::import
