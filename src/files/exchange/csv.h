/// A motion as a table of comma-separated values, for spreadsheets and everybody else.
///
/// A row per frame; the first row names the columns, each with its unit. The world is ours: z up. Columns:
/// `time_s`; the joints, `pelvis_x_m` …; the rotation of the pelvis in the world as a unit quaternion,
/// `root_qw` …; and, where the motion has them, the forces: per foot and for the rest of the body force,
/// centre of pressure and free moment, and the torques in the joints (child's frame, x to the left, y up, z
/// forward at rest). Forces are means over the interval that ends at the row. Cells of what is not known stay
/// empty: forces at the first frame, and the centre of pressure of what is not on the floor.
#pragma once

#include <string>
#include <string_view>

#include "files/floor_forces.h"

namespace mimicx::files {

/// How every file of ours begins.
inline constexpr std::string_view kCsvOpening = "time_s,pelvis_x_m,pelvis_y_m,pelvis_z_m,left_hip_x_m,";

std::string format_csv(const motion::Clip& clip, const std::optional<RecordedForces>& forces);

}  // namespace mimicx::files
