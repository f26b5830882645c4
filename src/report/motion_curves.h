/// What the report draws of a motion over its frames, and where an input breaks the physics that the cleaned
/// motion keeps.
///
/// Everything is in the terms of docs/metrics.md: the surface points, the 5 mm within which a point touches
/// the floor z = 0, differences of frames. A frame without a value is NaN.
#pragma once

#include <string>
#include <vector>

#include "motion/metrics.h"

namespace mimicx::report {

/// A value per frame.
struct MotionCurves {
  std::vector<double> pelvis_height;  ///< m
  std::vector<double> lowest;         ///< of the surface over the floor, mm
  std::vector<double> slide;          ///< FS of the frame and the next one, mm/frame; NaN without contact
  std::vector<double> acceleration;   ///< mean over the joints of |Δ²p| fps², m/s²; NaN at both ends
};
MotionCurves curves_of(const motion::MotionSamples& motion);

/// A motion with its curves.
struct MeasuredMotion {
  motion::MotionSamples samples;
  MotionCurves curves;
};
MeasuredMotion measured(motion::MotionSamples samples);

/// Mean distance of the joints of two motions, as many frames as both have, mm.
std::vector<double> joint_distances(const motion::MotionSamples& a, const motion::MotionSamples& b);

/// Frames `first` to `last`, both among them.
struct Span {
  int first, last;
};
/// The stretches of true frames.
std::vector<Span> spans_of(const std::vector<bool>& frames);

/// Where an input sinks, floats, slides and shakes. Whether a body should have stood is what the cleaned
/// motion says, so no jump is called floating.
struct Flaws {
  std::vector<bool> sinks;   ///< lowest point deeper than 5 mm
  std::vector<bool> floats;  ///< lowest point above 5 mm where the cleaned one touches the floor
  std::vector<bool>
      slides;  ///< a foot's points move 5 mm or more to the next frame where the cleaned ones stand
  std::vector<bool> shakes;  ///< the joints' mean acceleration is 2 m/s² or more above that of the cleaned
};
/// @param input, cleaned  at one frame rate; frames behind the end of either have no flaw
Flaws flaws_of(const MeasuredMotion& input, const MeasuredMotion& cleaned);

}  // namespace mimicx::report
