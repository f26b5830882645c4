/// Where a scene lies under a motion: the fit moves the motion by decimetres, and with it the place of its
/// steps and seats.                                                    docs/scenes.md, "Matching the fit"
#pragma once

#include "fit/least_squares/fit_kinematics.h"

namespace mimicx::fit {

/// The horizontal shift of the scene, at most 0.6 m along x and y, with which slow points of the feet are
/// most nearly on it, m. Of equally good ones the shortest; 0 on a flat floor.
/// @param settled  false: they may have one height over it in common
Eigen::Vector2d scene_shift(const PerFrame<FootPositions>& feet, double fps, const Scene& scene,
                            bool settled);

/// The scene with its plates moved.
Scene shifted(Scene scene, const Eigen::Vector2d& shift);

}  // namespace mimicx::fit
