/// `mimicx audit`: do the forces in a file explain the motion in it?                docs/physics.md §9
///
/// Inverse dynamics gives the forces that a motion requires (physics/inverse_dynamics.h, with other equations
/// than those that simulated it); the file has the forces that acted. The difference at the root is the
/// *unexplained root wrench*: an external wrench that would have to act on the body. There are three kinds of
/// evidence:
///  - physics steps (`substeps/NAME.npz`): everything is known at every step, as recorded in float32, and
///    replayed in double precision. The replay must be explained to rounding;
///  - frames (`motions/NAME.npz`): momentum at the frames against the mean forces between them, (10);
///  - poses alone (any other motion): the rest after the best possible ground reaction (audit/feasibility.h)
///    at every point of the body within 1 cm of the ground.
///
/// What it does not do: it simulates nothing new, and does not compare the motion with its input (metrics
/// do).
#pragma once

#include <vector>

#include "audit/audit_result.h"
#include "audit/substeps.h"
#include "motion/clip.h"
#include "physics/model.h"

namespace mimicx::audit {

/// The frames of a simulated motion and the forces between them; unit quaternions.
struct SimulatedFrames {
  Character character;
  double fps = 30.0;
  std::vector<motion::ReferenceFrame> frames;
  std::vector<rl::tracking::ActingForces> forces;  ///< means over the interval that ends at the frame
  Scene scene = {};                                ///< the ground
};

Audit audit_frames(const SimulatedFrames& motion, const physics::SimulationConfig& simulation);
/// As recorded, and replayed in double precision.
Audit audit_steps(const SubstepMotion& motion);
Audit audit_replayed_steps(const SubstepMotion& motion);
/// With the best possible ground reaction, at 30 fps. Other body models are replaced by the standard body.
Audit audit_poses(const motion::Clip& clip);

}  // namespace mimicx::audit
