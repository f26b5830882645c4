#include "import/body_mass.h"

#include <algorithm>
#include <cmath>

#include "character/standard_body.h"
#include "core/number_text.h"

namespace mimicx::import {
namespace {

constexpr double kStandardStature = 1.718;  ///< m, of the standard body from its soles to the top of its head
constexpr double kBodyMassIndex = 0.5 * (73.0 / (1.76 * 1.76) + 60.0 / (1.63 * 1.63));  ///< kg/m²
constexpr int kGirth = 1, kSize = 0;                                                    ///< indices of β
constexpr double kToldMass = 0.5;      ///< kg: a difference that the user has to know
constexpr double kToldStature = 0.01;  ///< m: the same
constexpr double kSizeGain = 0.03;     ///< of β₀

BodyLengths lengths_of_shape(const std::array<double, kBetas>& betas) {
  return lengths_of(joint_offsets(betas));
}

std::string decision_of(const char* why, double wanted, const std::array<double, kBetas>& betas) {
  const double mass = make_character(betas).total_mass();
  std::string decision = formatted("mass: %.1f kg, %s", mass, why);
  if (std::abs(mass - wanted) < 0.05) return decision;
  return decision + formatted(" (our body cannot have %.1f kg at its size)", wanted);
}

}  // namespace

double usual_stature(const BodyLengths& lengths) {
  const BodyLengths standard = lengths_of_shape({});
  double sum = 0.0, of_standard = 0.0;
  for (const Length length : {kThigh, kShank, kTrunk})
    if (lengths[length] > 0.0) {
      sum += lengths[length];
      of_standard += standard[length];
    }
  return of_standard > 0.0 ? kStandardStature * sum / of_standard : kStandardStature;
}

double usual_mass(double stature) { return kBodyMassIndex * stature * stature; }

std::array<double, kBetas> with_mass(std::array<double, kBetas> betas, double mass) {
  double least = -kMaxBeta, most = kMaxBeta;
  for (int step = 0; step < 60; ++step) {
    betas[kGirth] = 0.5 * (least + most);
    (make_character(betas).total_mass() < mass ? least : most) = betas[kGirth];
  }
  return betas;
}

std::string settle_mass(const KnownBody& known, std::array<double, kBetas>& betas) {
  const bool tall = !std::isnan(known.height);
  const double wanted = !std::isnan(known.mass)
                            ? known.mass
                            : usual_mass(tall ? known.height : usual_stature(lengths_of_shape(betas)));
  betas = with_mass(betas, wanted);
  return decision_of(!std::isnan(known.mass) ? "as asked for"
                     : tall                  ? "the usual one of the stature that was given"
                            : "the usual one of adults with such legs and trunk (--mass, --height)",
                     wanted, betas);
}

std::string settle_body(const KnownBody& known, std::array<double, kBetas>& betas) {
  if (!std::isnan(known.height)) {
    const double size = known.height / usual_stature(lengths_of_shape(betas));
    betas[kSize] = std::clamp(betas[kSize] + (size - 1.0) / kSizeGain, -kMaxBeta, kMaxBeta);
  }
  return settle_mass(known, betas);
}

std::string mass_warning(const KnownBody& known, const std::array<double, kBetas>& betas) {
  const double mass = make_character(betas).total_mass();
  if (std::isnan(known.mass) || std::abs(mass - known.mass) < kToldMass) return "";
  return formatted("mass: %.1f kg, because our body cannot have the %.1f kg of --mass at its size", mass,
                   known.mass);
}

std::string height_warning(const KnownBody& known, const std::array<double, kBetas>& betas) {
  const double stature = usual_stature(lengths_of_shape(betas));
  if (std::isnan(known.height) || std::abs(stature - known.height) < kToldStature) return "";
  return formatted("height: %.2f m, because our body cannot have the %.2f m of --height", stature,
                   known.height);
}

}  // namespace mimicx::import
