/// The audit by a second engine: the audit's numbers for a file from MuJoCo's inverse dynamics.
///
/// Rows as in audit/audit.h with `index`, `root` (unexplained wrench about the centre of mass) and
/// `torque_gap` (required against exported torque); everything else in them is zero. docs/physics.md §9
#pragma once

#include "audit/audit.h"

namespace mimicx::test {

/// The same motion with hinges exactly on their axes. In float32 they deviate by some 1e-6 rad, which
/// MuJoCo's hinges cannot represent; the engines would differ by 1e-6 of the forces.
audit::SubstepMotion on_hinge_axes(audit::SubstepMotion motion);
audit::SimulatedFrames on_hinge_axes(audit::SimulatedFrames motion);

/// As recorded, and replayed in double.
std::vector<audit::AuditRow> mujoco_audit_steps(const audit::SubstepMotion& motion);
std::vector<audit::AuditRow> mujoco_audit_replayed_steps(const audit::SubstepMotion& motion);
/// Momentum at the frames against the mean forces between them, (10).
std::vector<audit::AuditRow> mujoco_audit_frames(const audit::SimulatedFrames& motion,
                                                 const physics::SimulationConfig& simulation);

/// The largest difference between the two engines in a row's numbers, in N and N·m, in parts of the larger of
/// the weight and the floor's push.
double largest_difference(const audit::Audit& audit, const std::vector<audit::AuditRow>& rows);

}  // namespace mimicx::test
