/// Mass of a body of which only the places of the joints are known, or as the user gives it.
///
/// Joint positions do not determine the girth, β₁, so a shape that is fitted to them has an arbitrary mass.
/// People of stature H weigh BMI · H² on average, with a BMI that hardly depends on H (A. Keys et al., J.
/// Chronic Dis. 25 (1972)). The BMI here is the mean of the reference adults of ICRP Publication 89 (2002):
/// 73 kg at 1.76 m and 60 kg at 1.63 m, 23.1 kg/m². Single adults differ from it by about 15 % (one standard
/// deviation of young adults: NCD Risk Factor Collaboration, Lancet 387 (2016)).
///
/// What it does not do: children, who weigh less for their stature.
#pragma once

#include <array>
#include <limits>
#include <string>

#include "import/body_fit.h"

namespace mimicx::import {

/// Stature of a body with the standard body's proportions whose legs and trunk are as long, m.
double usual_stature(const BodyLengths& lengths);

/// Mass of an adult of this stature, kg.
double usual_mass(double stature);

/// The shape with the girth that brings the body nearest to a mass, kg.
std::array<double, kBetas> with_mass(std::array<double, kBetas> betas, double mass);

/// What the user knows of the person; NaN: unknown.
struct KnownBody {
  double mass = std::numeric_limits<double>::quiet_NaN();    ///< kg
  double height = std::numeric_limits<double>::quiet_NaN();  ///< stature, m
};

/// Gives a shape that was fitted to joints the mass that the user knows, or the usual one of the stature.
/// @return the decision, one line
std::string settle_mass(const KnownBody& known, std::array<double, kBetas>& betas);

/// Gives a file's shape, or the standard body, the stature and the mass that the user knows. The stature
/// scales the body as a whole; without a mass it has the usual one.
/// @return the decision, one line
std::string settle_body(const KnownBody& known, std::array<double, kBetas>& betas);

/// A warning where the body does not have the mass that the user knows; otherwise empty.
std::string mass_warning(const KnownBody& known, const std::array<double, kBetas>& betas);
/// What to tell where `settle_body` could not give the stature that was asked for; else empty.
std::string height_warning(const KnownBody& known, const std::array<double, kBetas>& betas);

}  // namespace mimicx::import
