/// feasibility/NAME.npz: the external force that a prepared reference would need, frame by frame.
/// docs/formats.md
///
/// From two sources: inverse dynamics of the poses alone (audit/pose_needs.h), for every reference; and the
/// assistive force that remained in a plan's assisted stage (control/plan.h), where there was one.
#pragma once

#include <filesystem>
#include <string>

#include "core/containers.h"
#include "core/npz/npz.h"
#include "core/so3.h"

namespace mimicx::record {

struct FrameFeasibility {
  double mass = 0.0;            ///< of the body, kg
  PerFrame<Vector6d> need;      ///< external moment about the centre of mass and force, N·m, N, world axes
  PerFrame<std::string> wrong;  ///< "feasible", or the fault in one word
  /// Assistive moment and force on the pelvis until the next frame, N·m, N, world axes, of the frames that
  /// the assisted stage reached; empty without one.
  PerFrame<Vector6d> assistance;

  /// Of the body's mass under a need or assistance, m/s².
  double acceleration(const Vector6d& wrench) const { return wrench.tail<3>().norm() / mass; }
};

void write_feasibility(const std::filesystem::path& path, const FrameFeasibility& feasibility);
/// @throws DataError naming file and member that is missing or of another shape
FrameFeasibility read_feasibility(const std::filesystem::path& path);
FrameFeasibility feasibility_from(const Npz& npz);

}  // namespace mimicx::record
