/// `mimicx audit`: do the forces in a file explain the motion in it?                docs/physics.md §9
///
/// Inverse dynamics says what a motion needs (physics/inverse_dynamics.h, other equations than those that
/// simulated it), the file says what acted. The difference at the root is the *unexplained root wrench*: what
/// a hand from outside would have to push with. There are three kinds of evidence:
///  - physics steps (`substeps/NAME.npz`): everything is known at every step; as recorded in float32, and
///    replayed in double precision, which must explain itself to rounding;
///  - frames (`motions/NAME.npz`): momentum at the frames against the mean forces between them, (10);
///  - poses alone (any other motion): what is left after the best ground reaction that is physically possible
///    (audit/feasibility.h), at every point of the body within 1 cm of the floor.
///
/// What it does not do: it never simulates anything new, and it says nothing about how close a motion is to
/// the input (metrics do).
#pragma once

#include <vector>

#include "audit/audit_result.h"
#include "audit/substeps.h"
#include "motion/clip.h"
#include "physics/model.h"

namespace mimicx::audit {

/// A simulated motion's frames with what acted between them; quaternions unit.
struct SimulatedFrames {
  Character character;
  double fps = 30.0;
  std::vector<motion::ReferenceFrame> frames;
  std::vector<rl::tracking::ActingForces> forces;  ///< means over the interval that ends at the frame
};

Audit audit_frames(const SimulatedFrames& motion, const physics::SimulationConfig& simulation);
/// As recorded, and replayed in double precision.
Audit audit_steps(const SubstepMotion& motion);
Audit audit_replayed_steps(const SubstepMotion& motion);
/// The floor's best case, at 30 fps. A foreign body model is looked at on the standard body.
Audit audit_poses(const motion::Clip& clip);

}  // namespace mimicx::audit
