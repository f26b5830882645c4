/// The certificate by the second engine: the audit's numbers for a file, from MuJoCo's inverse dynamics.
///
/// Rows as in pipeline/audit/audit.h with `index`, `root` (unexplained wrench about the centre of mass) and
/// `torque_gap` (required against exported torque); everything else in them is zero. docs/physics.md §9
#pragma once

#include "pipeline/audit/audit.h"

namespace mimicx {

/// The same motion with its hinges exactly on their axes. In float32 they turn off them by some 1e-6 rad,
/// which MuJoCo's cannot follow: 1e-6 of the forces would be the difference between the engines.
SubstepMotion on_hinge_axes(SubstepMotion motion);
SimulatedFrames on_hinge_axes(SimulatedFrames motion);

/// As recorded, and replayed in double.
std::vector<AuditRow> mujoco_audit_steps(const SubstepMotion& motion);
std::vector<AuditRow> mujoco_audit_replayed_steps(const SubstepMotion& motion);
/// Momentum at the frames against the mean forces between them, (10).
std::vector<AuditRow> mujoco_audit_frames(const SimulatedFrames& motion, const SimulationConfig& simulation);

/// The largest difference between the two engines in a row's numbers, in N and N·m, in parts of the larger of
/// the weight and the floor's push.
double largest_difference(const Audit& audit, const std::vector<AuditRow>& rows);

}  // namespace mimicx
