/// Corrects left and right of the detections: detectors sometimes exchange the sides of both arms or both
/// legs for a few frames. The keypoint fit repeats this before each of its steps.
#pragma once

#include "fit/least_squares/fit_problem.h"

namespace mimicx::fit {

/// Fills `FitProblem::uvc` with the detections. Left and right of the arms or of the legs are exchanged in
/// frames in which that fits the prediction much better.
/// @param detected   [frames][K] pixels and confidence, as in the file
/// @param predicted  [frames][K] pixels
/// @return number of frames with exchanged limbs
int order_left_and_right(const PerFrame<std::vector<Vector3d>>& detected,
                         const PerFrame<std::vector<Eigen::Vector2d>>& predicted, FitProblem& problem);

}  // namespace mimicx::fit
