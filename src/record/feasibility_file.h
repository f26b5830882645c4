/// feasibility/NAME.npz: what a prepared reference asks for that no body has, frame by frame. docs/formats.md
///
/// Two witnesses: inverse dynamics of the poses alone (audit/pose_needs.h), for every reference; and
/// the help that was left in a plan's soft stage (control/plan.h), where there was one.
#pragma once

#include <filesystem>
#include <string>

#include "core/containers.h"
#include "core/npz/npz.h"
#include "core/so3.h"

namespace mimicx::record {

struct FrameFeasibility {
  double mass = 0.0;        ///< of the body, kg
  PerFrame<Vector6d> need;  ///< moment about the centre of mass and force from outside, N·m, N, world axes
  PerFrame<std::string> wrong;  ///< "feasible", or what is wrong in a word
  PerFrame<Vector6d> help;  ///< moment and force on the pelvis from this frame to the next, N·m, N, world
                            ///< axes, as far as the soft stage came; empty without one

  /// Of a need or help, m/s².
  double acceleration(const Vector6d& wrench) const { return wrench.tail<3>().norm() / mass; }
};

void write_feasibility(const std::filesystem::path& path, const FrameFeasibility& feasibility);
/// @throws DataError naming file and member that is not there, or not of its shape
FrameFeasibility read_feasibility(const std::filesystem::path& path);
FrameFeasibility feasibility_from(const Npz& npz);

}  // namespace mimicx::record
