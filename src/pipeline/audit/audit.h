/// `mimicx audit`: do the forces in a file explain the motion in it?                docs/physics.md §9
///
/// Inverse dynamics says what a motion needs (physics/inverse_dynamics.h, other equations than those that
/// simulated it), the file says what acted. What is left at the root is the *unexplained root wrench*: a hand
/// from outside that would have to hold the body. Three kinds of evidence:
///  - physics steps (`substeps/NAME.npz`): everything is known at every step; as recorded in float32, and
///    replayed in double precision, which must explain itself to rounding;
///  - frames (`motions/NAME.npz`): momentum at the frames against the mean forces between them, (10);
///  - poses alone (any other motion): what is left after the best ground reaction that is physically possible
///    (pipeline/audit/feasibility.h), at every point of the body within 1 cm of the floor.
///
/// What it does not do: it never simulates anything new, and it says nothing about how close a motion is to
/// the input (metrics do).
#pragma once

#include <string>
#include <vector>

#include "motion/clip.h"
#include "physics/model.h"
#include "pipeline/audit/substeps.h"
#include "pipeline/record/manifest.h"

namespace mimicx {

/// Over and under the floor within which a pose's points touch it, m.
inline constexpr double kFloorReach = 0.01;

enum class Evidence { kSteps, kReplayedSteps, kFrames, kPosesAlone };

/// One physics step, or the interval that ends at a frame. Zero where the evidence has no such number.
struct AuditRow {
  int index = 0;                       ///< of the step, or of the frame that ends the interval
  Vector6d root = Vector6d::Zero();    ///< unexplained: moment about the centre of mass, N·m; force, N
  double torque_gap = 0.0;             ///< largest |required − exported| torque of a joint, N·m
  double torque_share = 0.0;           ///< largest PD torque of a joint, 1 = its bound
  double normal = 0.0;                 ///< floor's push on all bodies, N
  double pull = 0.0;                   ///< the part of it that pulls down, N
  double beyond_cone = 0.0;            ///< horizontal force beyond μ times the push, N
  double in_air = 0.0;                 ///< the floor's force on bodies more than 2 cm above it, N
  double power = 0.0;                  ///< of all joint torques, W
  double travel = 0.0;                 ///< of the centre of mass beyond its velocities, in parts of (11)
  double lowest = 0.0;                 ///< contact point over the floor, m
  double replay_gap = 0.0;             ///< of the floor's whole force, recorded against replayed, N
  double positive = 0.0, total = 0.0;  ///< power of the joints that drive; sum of all sizes, W
};

struct Audit {
  Evidence evidence = Evidence::kPosesAlone;
  double weight = 0.0;  ///< N
  double rate = 30.0;   ///< rows per second
  std::vector<AuditRow> rows;
  std::vector<std::string> failures;  ///< why it fails, a line each; empty: it passes
};

/// A simulated motion's frames with what acted between them; quaternions unit.
struct SimulatedFrames {
  Character character;
  double fps = 30.0;
  std::vector<ReferenceFrame> frames;
  std::vector<rl::ActingForces> forces;  ///< means over the interval that ends at the frame
};

Audit audit_frames(const SimulatedFrames& motion, const SimulationOptions& simulation);
/// As recorded, and replayed in double precision.
Audit audit_steps(const SubstepMotion& motion);
Audit audit_replayed_steps(const SubstepMotion& motion);
/// The floor's best case, at 30 fps. A foreign body model is looked at on the standard body.
Audit audit_poses(const Clip& clip);

/// Why an audit fails, a line each: more unexplained than its evidence allows, exported torques that are not
/// the required ones, torques over their bounds, floor forces that no floor gives, velocities that do not fit
/// the positions. Limits: docs/physics.md §9.
std::vector<std::string> failures_of(const Audit& audit);

/// Means, largest values, counts, work, by name; units are in the names.
NamedValues summary_of(const Audit& audit);
/// One of them; NaN, which passes no limit, where the evidence has no such number.
double value_of(const NamedValues& summary, const std::string& name);

}  // namespace mimicx
