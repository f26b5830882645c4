/// Motion features of a clip, 68 numbers: height and turning of the root, speeds and accelerations of the
/// joints.
///                                                                              Eq. 1; docs/method.md §6
///
/// Source: Eq. 1 of the paper, after Onuma et al. 2008 and Won et al. 2020. Every entry but the first is the
/// mean over the frames of a squared speed or acceleration, in SI units:
///
///     root_height              m         mean height of the pelvis over the floor
///     root_turning             rad²/s²   squared angular velocity of the pelvis about the vertical
///     planar_velocity.JOINT    m²/s²     squared horizontal velocity, 22 joints in the order of `Body`
///     vertical_velocity.JOINT  m²/s²     squared vertical velocity (the print drops its formula)
///     acceleration.JOINT       m²/s⁴     squared acceleration
///
/// Velocities are world velocities in the root's heading frame, so locomotion counts. Turning the axes about
/// the vertical changes neither a horizontal length, nor a vertical one, nor the length of an acceleration,
/// and only lengths enter: the rotation need not be carried out.
///
/// Smoothing: values and derivatives at a frame are those of the parabola that fits the frames within
/// 0.133 s of it best in the least-squares sense (Savitzky and Golay 1964; 9 frames at 30 fps; at the ends
/// the nearest 9). Exact for constant velocity and for free fall, to the first and last frame; white noise of
/// 5 mm in a coordinate leaves 0.5 m/s² of its acceleration instead of the 11 m/s² of plain differences.
///
/// What it does not do: the features do not depend on the place, heading or order of a motion's parts.
#pragma once

#include <string>
#include <string_view>

#include "motion/reference.h"

namespace mimicx::pipeline::options {

inline constexpr int kFeatures = 2 + 3 * kBodies;

/// In the order above, SI units.
using MotionFeatures = Array<double, kFeatures>;

/// Index of the first entry of each kind; joint entries follow the order of `Body`.
inline constexpr int kRootHeight = 0;
inline constexpr int kRootTurning = 1;
inline constexpr int kPlanarVelocity = 2;
inline constexpr int kVerticalVelocity = kPlanarVelocity + kBodies;
inline constexpr int kAcceleration = kVerticalVelocity + kBodies;

/// One of the five kinds of features of Eq. 1.
struct FeatureKind {
  std::string_view name;
  int first;    ///< index of its first entry
  int entries;  ///< 1, or one per body
  double unit;  ///< of an entry: this times √entries, so that all of a kind together weigh as much as one
};

inline constexpr int kFeatureKindCount = 5;
/// The unit is about the geometric mean of two standard deviations of an entry: that over the 112 synthetic
/// motions of the options' training, and that over 17 real clips (docs/method.md §6).
inline constexpr Array<FeatureKind, kFeatureKindCount> kFeatureKinds = {{{
    {"root_height", kRootHeight, 1, 0.08},                    // m
    {"root_turning", kRootTurning, 1, 0.1},                   // rad²/s²
    {"planar_velocity", kPlanarVelocity, kBodies, 0.45},      // m²/s²
    {"vertical_velocity", kVerticalVelocity, kBodies, 0.13},  // m²/s²
    {"acceleration", kAcceleration, kBodies, 23.0},           // m²/s⁴
}}};

/// "root_height", …, "acceleration.right_wrist".
const Array<std::string, kFeatures>& feature_names();

/// @param reference  poses, and the root's angular velocities, must be set, as `prepare_reference` does
/// @throws DataError for fewer than 3 frames
MotionFeatures motion_features(const motion::Reference& reference);

/// Length of each feature's axis: distances between motions are Euclidean in features / units. Constants, not
/// computed from the data: a distance means the same in every set of motions, and a new clip can be compared
/// with existing clusters.
const MotionFeatures& feature_units();

/// features / units, entry by entry.
MotionFeatures scaled_features(const MotionFeatures& features);

/// The share of every kind in the variance of the scaled features of these motions, in the order of
/// kFeatureKinds: how much it contributes to what sets them apart. All 0 if nothing does.
Array<double, kFeatureKindCount> kind_shares(const List<MotionFeatures>& motions);

}  // namespace mimicx::pipeline::options
