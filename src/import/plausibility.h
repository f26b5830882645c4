/// Detects up axis, unit of length, frame rate and floor of a motion, and implausible speeds.
///
/// A file that is read with the wrong axes, unit or frame rate still holds valid numbers, but its motion is
/// implausible: one foot of a human is nearly at rest most of the time, the body stands along the vertical,
/// and it falls with g when nothing supports it.
/// Thresholds and what they were measured on: docs/formats.md, "What reading decides".
///
/// What it does not do: no change of the clip (world_transform.h does), no repair of single frames
/// (motion/prepare/glitches.h).
#pragma once

#include <optional>
#include <string>

#include "motion/clip.h"

namespace mimicx::import {

/// A number with three significant digits, for sentences.
std::string short_number(double value);

/// Median over the frames of the speed of the slowest joint, m/s: the joint that supports the body hardly
/// moves.
double support_speed(const motion::Clip& clip);

/// Whether a motion is implausible in metres and plausible in another unit.
/// @param speed, speed_scaled  `support_speed` as the file is, and in the other unit
bool is_wrong_scale(const motion::Clip& clip, double speed, double speed_scaled);

/// The unit of `trans` in metres: 1, 0.01 or 0.001.
double detect_scale(const motion::Clip& clip);

struct UpAxis {
  char axis = 'z';     ///< 'x', 'y', 'z'; capital letters: the negative axes
  bool sure = false;   ///< false: the body lies or turns over, and z is kept
  double along = 0.0;  ///< mean component along the axis of the unit vector from the feet to the neck
};
/// The axis of the world along which the body stands. An axis other than z must be better in two ways: the
/// body stands along it, and the floor stops the body in its direction. (A body that crawls lies along the
/// floor.)
UpAxis detect_up(const motion::Clip& clip);

/// The frame rate at which a motion falls with g.
struct FallRate {
  int flights = 0;          ///< flights that follow a parabola
  double acceleration = 0;  ///< downward, at the file's frame rate, m/s²
  double fps = 0;           ///< the frame rate at which the body falls with g
  /// Whether at least three flights give this rate independently. A single flight is not reliable: a toe may
  /// still stand, or the floor may drift.
  bool agreed = false;
};
/// The frame rate from the body's flights, in which nothing touches the floor and the centre of mass follows
/// a parabola. None without a flight that is long and clean enough.
std::optional<FallRate> rate_from_flights(const motion::Clip& clip);

/// Height of the floor: a low percentile of the heights of the body's lowest point, m.
double detect_floor(const motion::Clip& clip);

/// Warnings of speeds that no human reaches.
std::vector<std::string> implausible_speeds(const motion::Clip& clip);

}  // namespace mimicx::import
