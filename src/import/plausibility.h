/// Whether a motion can be what its file says: up axis, unit of length, frame rate, floor, speeds.
///
/// A file that is read in the wrong axes, unit or frame rate still holds valid numbers. The motion shows such
/// a mistake: one foot of a human is nearly at rest most of the time, the body stands along the vertical, and
/// it falls with g when nothing carries it.
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

/// Median over the frames of the speed of the stillest joint, m/s: what carries the body hardly moves.
double support_speed(const motion::Clip& clip);

/// Whether a motion cannot be in metres, and in another unit can.
/// @param speed, speed_scaled  `support_speed` as the file is, and in the other unit
bool is_wrong_scale(const motion::Clip& clip, double speed, double speed_scaled);

/// The unit of `trans` in metres: 1, 0.01 or 0.001.
double detect_scale(const motion::Clip& clip);

struct UpAxis {
  char axis = 'z';     ///< 'x', 'y', 'z'; capital letters: the negative axes
  bool sure = false;   ///< false: the body lies or turns over, and z is believed
  double along = 0.0;  ///< mean component along the axis of the unit vector from the feet to the neck
};
/// Along which axis of the world the body stands. Another axis than z must be better in two ways: the body
/// stands along it, and the floor stops the body there. (A body that crawls lies along the floor.)
UpAxis detect_up(const motion::Clip& clip);

/// The frame rate at which a motion falls with g.
struct FallRate {
  int flights = 0;          ///< that fall along a parabola
  double acceleration = 0;  ///< downward, at the file's frame rate, m/s²
  double fps = 0;           ///< the frame rate at which the body falls with g
  /// Three flights or more, and each alone says this rate. One flight may be a toe that stands, or a floor
  /// that drifts: nothing is decided by it.
  bool agreed = false;
};
/// From the flights of the body: nothing touches the floor, and the centre of mass falls along a parabola.
/// None where there is no flight that is long and clean enough.
std::optional<FallRate> rate_from_flights(const motion::Clip& clip);

/// Height of the floor: the low percentile of the lowest point of the body, m.
double detect_floor(const motion::Clip& clip);

/// Speeds that no human has, in words; empty where all is well.
std::vector<std::string> implausible_speeds(const motion::Clip& clip);

}  // namespace mimicx::import
