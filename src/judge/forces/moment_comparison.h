/// Joint moments of simulated motions against those of OpenSim's inverse dynamics: `mimicx evaluate --forces`
/// with a .sto.
///
/// The file has the generalised forces of a gait model, hip_flexion_r_moment, knee_angle_r_moment,
/// ankle_angle_r_moment and those of `l`, N·m. The motion's are the same as `files::format_sto` writes them,
/// each over the mass of its body. A motion's moment is a mean over the interval that ends at its frame; the
/// file's is averaged over the same interval, counted from `time_of_first_frame` (paired_series.h).
///
/// Signs are those of gait2392 and gait10dof18musc: positive flexes the hip, extends the knee, lifts the
/// toes. Rajagopal's model has its knee the other way round.
#pragma once

#include "audit/audit.h"
#include "import/opensim/storage_table.h"

namespace mimicx::judge {

/// The values of `moment_columns()` (force_comparison.h).
/// @param mass  of the person, kg; NaN: that of the simulated body
/// @param path  of the table, for messages
/// @throws DataError for a table without one of these columns, and if the two have fewer than five frames in
/// common
std::vector<double> compare_inverse_dynamics(const audit::SimulatedFrames& motion,
                                             const import::StorageTable& table, double mass,
                                             const std::string& path);

}  // namespace mimicx::judge
