/// Curves of a motion over its frames, and the frames in which an input is physically implausible where the
/// cleaned motion is not.
///
/// Surface points, the 5 mm within which a point touches the floor z = 0, and differences of frames are those
/// of docs/metrics.md. A frame without a value is NaN.
#pragma once

#include <vector>

#include "motion/metrics.h"

namespace mimicx::report {

/// A value per frame.
struct MotionCurves {
  std::vector<double> pelvis_height;  ///< m
  std::vector<double> lowest;         ///< of the surface over the floor, mm
  std::vector<double> slip;          ///< of the loaded feet (audit/slip.h), mm in 1/30 s; NaN: none is loaded
  std::vector<double> acceleration;  ///< mean over the joints of |Δ²p| fps², m/s²; NaN at both ends
};
/// All but the slip, which needs forces.
MotionCurves curves_of(const motion::MotionSamples& motion);

/// A motion with its curves.
struct MeasuredMotion {
  motion::MotionSamples samples;
  MotionCurves curves;
};
/// @param slip  a value per frame
MeasuredMotion measured(motion::MotionSamples samples, std::vector<double> slip);

/// Mean distance of the joints of two motions over their common frames, mm.
std::vector<double> joint_distances(const motion::MotionSamples& a, const motion::MotionSamples& b);

/// Frames `first` to `last`, both included.
struct Span {
  int first, last;
};
/// The stretches of true frames.
std::vector<Span> spans_of(const std::vector<bool>& frames);

/// Frames in which an input sinks, floats, slides and shakes. The cleaned motion decides whether the body
/// should stand, so a jump is not called floating.
struct Flaws {
  std::vector<bool> sinks;   ///< lowest point deeper than 5 mm
  std::vector<bool> floats;  ///< lowest point above 5 mm while the cleaned motion touches the floor
  std::vector<bool> slides;  ///< loaded feet slip by more than audit::kVisibleSlip
  std::vector<bool> shakes;  ///< the joints' mean acceleration is 2 m/s² or more above the cleaned one's
};
/// @param input, cleaned  at one frame rate; frames behind the end of either have no flaw
Flaws flaws_of(const MeasuredMotion& input, const MeasuredMotion& cleaned);

}  // namespace mimicx::report
