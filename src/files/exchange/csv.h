/// A motion as a table of comma-separated values, for spreadsheets.
///
/// A row per frame; the first row names the columns, each with its unit. The world is ours: z up. Columns:
/// `time_s`; the joints, `pelvis_x_m` …; the rotation of the pelvis in the world as a unit quaternion,
/// `root_qw` …; and, where the motion has them, the forces: per foot and for the rest of the body force,
/// centre of pressure and free moment, and the torques in the joints (child's frame, x to the left, y up, z
/// forward at rest). Forces are means over the interval that ends at the row. Unknown values are empty cells:
/// forces at the first frame, and the centre of pressure of a foot that is not on the floor.
#pragma once

#include <string>
#include <string_view>

#include "files/floor_forces.h"

namespace mimicx::files {

/// The first bytes of every file that is written here.
inline constexpr std::string_view kCsvOpening = "time_s,pelvis_x_m,pelvis_y_m,pelvis_z_m,left_hip_x_m,";

std::string format_csv(const motion::Clip& clip, const std::optional<RecordedForces>& forces);

}  // namespace mimicx::files
