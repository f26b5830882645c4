/// The metrics that need the floor's forces: slip and chatter. docs/metrics.md
#pragma once

#include "audit/slip.h"
#include "core/units.h"
#include "motion/clip.h"
#include "motion/metrics.h"

namespace mimicx::judge {

/// A motion whose floor forces are known.
struct LoadedMotion {
  const Character& character;
  const PerFrame<BodyPoses>& poses;
  const audit::FloorWrenches& ground;
  double fps = 30.0;
  const Scene& scene;
  double gravity = kGravity;  ///< of the simulation, m/s²
};

/// Upward force of the floor on the whole body, without the first frame, which has none, N.
List<double> vertical_forces(const audit::FloorWrenches& ground);

/// Slip and chatter of a simulated motion.
/// @return its slip, frame by frame
audit::Slip judge_forces(const LoadedMotion& motion, motion::Metrics& metrics);

/// Slip of poses, with their best floor forces. They have no chatter, because these forces are smoothed.
/// @return its slip, frame by frame
audit::Slip judge_poses(const Character& character, const PerFrame<BodyPoses>& poses, double fps,
                        const Scene& scene, double gravity, motion::Metrics& metrics);

/// Of a clip: by its recorded forces at its own rate, or else by its poses at motion::kMetricRate.
/// @throws DataError as `files::recorded_forces`
audit::Slip judge_clip(const motion::Clip& clip, motion::Metrics& metrics);

}  // namespace mimicx::judge
