/// How fast the feet slide where they carry the body.                       docs/metrics.md, "Sliding", (1)
/// to (4)
///
/// The sole's material point at the centre of pressure stands still while a foot stands or rolls; how far it
/// moves in a frame is the foot's slip. Slips count by their load, so a foot that hardly touches hardly
/// counts. Loads are the recorded forces of a simulated motion. For poses alone they are the best floor
/// forces: those that explain the motion, with the least slip, on the points that are lowest in the frame.
/// Their floor is where the lowest standing points around each frame are, over the ground of the scene, so an
/// input that hovers, sinks or drifts in height can be compared with a result that stands.
///
/// What it does not do: a whole body that flies is not detected by its height, but by its needs: it falls,
/// so nothing loads its feet.
#pragma once

#include <limits>

#include "character/character.h"
#include "core/containers.h"
#include "core/units.h"
#include "motion/clip.h"

namespace mimicx::audit {

/// A foot that the floor pushes with less than this is not loaded, of the weight.
inline constexpr double kLeastFootLoad = 0.05;
/// A loaded foot that moves more than this slips, mm in 1/30 s.
inline constexpr double kVisibleSlip = 3.0;

/// (moment about the joint centre, force) of the floor on each body, world axes, N·m, N; means over the
/// interval that ends at the frame. Entry 0 is not used.
using FloorWrenches = PerFrame<PerBody<Vector6d>>;

struct Slip {
  double mean = std::numeric_limits<double>::quiet_NaN();   ///< (2), mm in 1/30 s; NaN: nothing is loaded
  double share = std::numeric_limits<double>::quiet_NaN();  ///< of loaded feet over kVisibleSlip, %
  int loaded = 0;                                           ///< feet times frames that are loaded
  PerFrame<double> speed;  ///< of the frame's feet by their load, mm in 1/30 s; NaN: none is loaded
};

/// @param weight  of the body, N
/// @throws std::invalid_argument if poses and wrenches differ in length
Slip slip_of(const PerFrame<BodyPoses>& poses, const FloorWrenches& ground, double weight, double fps,
             const Scene& scene = {});

/// The forces that a motion needs from the floor, as far as its lowest points can supply them, (3), (4).
struct FloorForces {
  FloorWrenches ground;     ///< zero for fewer than 3 frames
  PerFrame<double> height;  ///< of the floor that gives them, over the ground of the scene, m
};
FloorForces best_floor_forces(const Character& character, const PerFrame<BodyPoses>& poses, double fps,
                              const Scene& scene, double gravity);
/// Slip by these forces.
Slip slip_of_poses(const Character& character, const PerFrame<BodyPoses>& poses, double fps,
                   const Scene& scene, double gravity);
/// The same of a clip's poses at motion::kMetricRate.
Slip slip_of_clip(const motion::Clip& clip, double gravity);

}  // namespace mimicx::audit
