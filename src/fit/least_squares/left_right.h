/// Puts left and right of the detections in order: detectors sometimes exchange the sides of both arms or
/// both legs for a few frames. The keypoint fit does this anew before each of its steps.
#pragma once

#include "fit/least_squares/fit_problem.h"

namespace mimicx::fit {

/// Fills `FitProblem::uvc` with the detections. Left and right of the arms or of the legs change places in
/// the frames in which they then fit the prediction much better.
/// @param detected   [frames][K] pixels and confidence, as in the file
/// @param predicted  [frames][K] pixels
/// @return number of frames in which a limb differs from the file
int order_labels(const PerFrame<std::vector<Vector3d>>& detected,
                 const PerFrame<std::vector<Eigen::Vector2d>>& predicted, FitProblem& problem);

}  // namespace mimicx::fit
