/// Left and right of the detections in order: what the keypoint fit decides anew before each step.
///
/// Detectors sometimes exchange the sides of both arms or both legs for a few frames.
#pragma once

#include "motion/fit/problem.h"

namespace mimicx::motion::fit {

/// Fills `FitProblem::uvc` with the detections; in frames in which the prediction strongly prefers it, left
/// and right of the arms or of the legs change places.
/// @param detected   [frames][K] pixels and confidence, as in the file
/// @param predicted  [frames][K] pixels
/// @return number of frames in which a limb differs from the file
int order_labels(const PerFrame<std::vector<Vector3d>>& detected,
                 const PerFrame<std::vector<Eigen::Vector2d>>& predicted, FitProblem& problem);

}  // namespace mimicx::motion::fit
