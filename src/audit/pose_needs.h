/// What a motion needs from outside, frame by frame, whoever made it: its feasibility. docs/physics.md §9
///
/// Newton and Euler say which moment and force the whole body needs so that it moves as its poses do
/// (audit/body_loads.h). The best forces that a floor could give at the points near it, inside cones
/// of friction of eight edges, take off what they can (audit/non_negative_least_squares.h; a N·m counts as
/// much as a N). What is left somebody would have to push with.
///
/// Real poses tremble, and their second differences are noise. So a frame's need is a mean of those around
/// it: the weights are those which turn second differences into the second derivative of the parabola that
/// fits 2m + 1 frames best (A. Savitzky, M. J. E. Golay, Anal. Chem. 36 (1964)),
///     w_j ∝ (m² − j²)((m + 1)² − j²),  |j| < m,  m = window · fps, at least 1   (docs/physics.md §9, (13))
/// which passes half of the amplitude at 0.45/window Hz. The mean of feasible needs is feasible for
/// the points that touched at any of the frames in it; these are allowed to push, each where it was, relative
/// to the centre of mass, at the frame nearest to the one in question. So smoothing never makes a feasible
/// motion infeasible; what it hides is what lasts shorter than the window.
///
/// What it does not do: no contact has to be consistent with the next frame, points may slide under load,
/// joints have no bounds (their torques are reported), and nothing but the floor z = 0 carries anybody.
#pragma once

#include "character/character.h"
#include "core/containers.h"

namespace mimicx::audit {

struct PoseNeedsConfig {
  double window = 0.1;    ///< half of the time over which a parabola is fitted, s
  double reach = 0.02;    ///< up to which a point over the floor touches it, m; any depth under it touches
  double friction = 1.0;  ///< μ
};

/// One frame.
struct PoseNeed {
  Vector3d force = Vector3d::Zero();   ///< from outside, N
  Vector3d moment = Vector3d::Zero();  ///< from outside, about the centre of mass, N·m
  double floor = 0.0;                  ///< what the floor pushes up with, N
  int points = 0;                      ///< contact points that may push
  double lowest = 0.0;                 ///< height of the lowest contact point, m
  PerBody<double> torque{};            ///< of each joint in parts of its bound; [0] is 0
};

struct PoseNeeds {
  double mass = 0.0, weight = 0.0;  ///< kg, N
  double fps = 30.0;
  PerFrame<PoseNeed> frames;  ///< the first and the last need what their neighbours need
};

/// @throws std::invalid_argument for fewer than 3 frames, or a setting out of its range
PoseNeeds needs_of_poses(const Character& character, const PerFrame<BodyPoses>& poses, double fps,
                         const PoseNeedsConfig& config = {});

}  // namespace mimicx::audit
