/// The frame rate of a motion: from a frame time that is printed with few digits, and from falls.
///
/// Where a body flies it falls with g; the rate at which it does is that of the recording. Most motions have
/// no flight, and then nothing but the file tells the rate. Thresholds and how often each rule is right:
/// docs/formats.md, "What reading decides".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motion/clip.h"

namespace mimicx::import {

/// A frame rate with six significant digits: 59.9401, 30.
std::string rate_text(double fps);

/// The frame rate of a file that prints the duration of a frame.
///
/// Files print few digits: 0.0333 for 30 fps, 0.0083 for 120. Of the rates in use (24, 25, 30, 50, 60 …, then
/// 23.976, 29.97, 59.94 …) the nearest one counts whose duration prints as this text, rounded or cut off.
/// Else it is the reciprocal, to the nearest whole number where that is within 0.05 %.
/// @param text  as the file has it @param seconds  its value, > 0
double rate_of_frame_time(std::string_view text, double seconds);

/// The frame rate in use that is next to `fps`, where one is within a tenth; else 0.
double usual_rate(double fps);

/// @throws DataError where a frame rate is the time step of one in use, such as 1/30
void require_no_time_step(const std::string& path, double fps);

/// Warnings of a rate that no recording has, or that is suspiciously the number of frames.
std::vector<std::string> odd_rate_warnings(double fps, int frames);

/// The frame rate at which a motion falls with g.
struct FallRate {
  int flights = 0;          ///< flights that follow a parabola
  double acceleration = 0;  ///< downward, at the file's frame rate, m/s²
  double fps = 0;           ///< the frame rate at which the body falls with g
  /// Whether at least three flights give this rate independently. A single flight is not reliable: a toe may
  /// still stand, or the floor may drift.
  bool agreed = false;
  /// Whether the flights are worth a warning: two that agree, or one that rises far.
  bool clear = false;
};
/// The frame rate from the body's flights, in which nothing touches the floor and the centre of mass follows
/// a parabola. None without a flight that is long and clean enough.
std::optional<FallRate> rate_from_flights(const motion::Clip& clip);

}  // namespace mimicx::import
