/// The result of an audit: the kind of evidence, a row of numbers per step or frame, and why it fails.
#pragma once

#include <string>
#include <vector>

#include "core/so3.h"

namespace mimicx::audit {

/// A point of a pose at most this far above or below the floor touches it, m.
inline constexpr double kFloorReach = 0.01;

enum class Evidence { kSteps, kReplayedSteps, kFrames, kPosesAlone };

/// One physics step, or the interval that ends at a frame. Zero for numbers that this evidence lacks.
struct AuditRow {
  int index = 0;                     ///< of the step, or of the frame that ends the interval
  Vector6d root = Vector6d::Zero();  ///< unexplained: moment about the centre of mass, N·m; force, N
  double torque_gap = 0.0;           ///< largest |required − exported| torque of a joint, N·m
  double torque_share = 0.0;         ///< largest PD torque of a joint, 1 = its bound
  double normal = 0.0;               ///< floor's normal force on all bodies, N
  double pull = 0.0;                 ///< downward part of the floor's force, N
  double beyond_cone = 0.0;          ///< horizontal force beyond μ times the push, N
  double in_air = 0.0;               ///< the floor's force on bodies more than 2 cm above it, N
  double power = 0.0;                ///< of all joint torques, W
  double travel = 0.0;      ///< of the centre of mass beyond its velocities, in parts of the bound (12)
  double lowest = 0.0;      ///< contact point over the floor, m
  double replay_gap = 0.0;  ///< of the floor's whole force, recorded against replayed, N
  double positive = 0.0, total = 0.0;  ///< sum of positive joint powers; sum of their magnitudes, W
};

struct Audit {
  Evidence evidence = Evidence::kPosesAlone;
  double weight = 0.0;  ///< N
  double rate = 30.0;   ///< rows per second
  std::vector<AuditRow> rows;
  std::vector<std::string> failures;  ///< why it fails, a line each; empty: it passes
};

}  // namespace mimicx::audit
