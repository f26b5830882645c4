/// Forces of the floor on both feet that plates have measured.
///
/// Two formats. OpenSim's .mot: y up, metres, newtons, columns ground_force_r_vx … or, as older files have
/// them, ground_force_vx … of the right and 1_ground_force_vx … of the left foot; (x, y, z) there is
/// (x, −z, y) here. Forces of ground_force_o_vx … are on the rest of the body, as `mimicx convert` writes
/// them; such a file has all forces. A further plate under load belongs to no foot and is refused. An .npz:
/// grf_left, grf_right (samples, 3) in N and cop_left, cop_right (samples, 3) in m, z up; grf_fps; optional
/// valid (samples, 2), mass in kg, joints (frames, 22, 3) with fps.
///
/// Where a file does not say `valid`, an unloaded foot may be in the air or on the floor beside the plates.
/// It counts as in the air between its first and its last load, as in the flight of a jump, and for kSwing
/// before and after, because it lands from the air and leaves into it. The other samples are not valid.
///
/// What it does not do: nothing is filtered.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "character/bodies.h"
#include "core/containers.h"

namespace mimicx::import {

inline constexpr double kLeastPress = 20.0;  ///< N; a foot that a plate pushes up with more presses it
inline constexpr double kSwing = 0.1;        ///< s

struct ForceSample {
  double time = 0.0;                    ///< s
  Array<Vector3d, 2> force, pressure;   ///< [left, right] N; centre of pressure, m, not finite: unknown
  Vector3d rest = Vector3d::Zero();     ///< force on the rest of the body, N
  Array<bool, 2> valid = {true, true};  ///< the foot is on a plate, or on nothing
};

struct MeasuredForces {
  std::vector<ForceSample> samples;                        ///< the first at the motion's frame 0
  double mass = std::numeric_limits<double>::quiet_NaN();  ///< kg; NaN: unknown
  PerFrame<PerBody<Vector3d>> joints;                      ///< of the person, m; empty: unknown
  double joints_fps = 0.0;
  std::string told;  ///< which samples are valid, one line; empty: the file says it, or all are
};

/// @throws DataError for a file that is none of these, and for one with forces of a further plate
MeasuredForces read_measured_forces(const std::filesystem::path& path);
/// @param path  for messages
MeasuredForces measured_forces_from(const std::string& bytes, const std::filesystem::path& path);

}  // namespace mimicx::import
