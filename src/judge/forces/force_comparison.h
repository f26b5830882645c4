/// Forces of simulated motions against forces that plates have measured, and their moments against those of
/// OpenSim's inverse dynamics: `mimicx evaluate --forces`.
///
/// Definitions and columns: docs/forces.md. Forces are means over the motion's intervals, in each body's own
/// weight, along (forward, left, up) of the hips. Frames 0 and 1 and the last one do not count, nor do frames
/// in which a foot is not on a plate.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/load_sharing/load_sharing.h"
#include "import/opensim/measured_forces.h"

namespace mimicx::judge {

/// A column of the table, and how it is printed.
struct ForceColumn {
  const char* name;
  const char* format;   ///< of printf
  const char* meaning;  ///< with its unit
};
const std::vector<ForceColumn>& force_columns();
/// Of a comparison with OpenSim's inverse dynamics (moment_comparison.h).
const std::vector<ForceColumn>& moment_columns();

struct ForceRow {
  std::string name;
  std::string reason;             ///< why there are no values, one line; empty: there are
  std::vector<double> values;     ///< per column; NaN: none
  std::vector<std::string> told;  ///< which samples count and where the mass is from, a line each
};

struct ForceTable {
  const std::vector<ForceColumn>* columns;
  std::vector<ForceRow> rows;
};

struct ComparedMotion {
  std::vector<double> values;     ///< of `force_columns()`; NaN: none
  std::vector<std::string> told;  ///< as in ForceRow, without the file's name
};

/// @param sharing  of the motion's frames
/// @param mass  of the person, kg; NaN: that of the measurement, or else the one with which the plates push
///              as much, over the frames that count, as the motion needs
/// @throws DataError if the two have fewer than five frames in common, and if there is no mass
ComparedMotion compare_forces(const audit::SimulatedFrames& motion,
                              const PerFrame<audit::LoadSharing>& sharing,
                              const import::MeasuredForces& measured, double mass);

/// Pairs files of the same name ("walk" also for walk_grf.mot and walk_ID.sto) in two folders, or two files.
/// A .sto, and a folder without .npz and .mot but with these, is compared by `moment_columns()`.
/// @throws DataError for a missing path, and if there is no measurement
ForceTable evaluate_forces(const std::filesystem::path& measured, const std::filesystem::path& motions,
                           double mass);

/// A line per motion and one of means.
std::string format_forces(const ForceTable& table);
/// {"columns": [{name, meaning}], "motions": [{name, reason, values}], "mean"}
std::string forces_json(const ForceTable& table);

}  // namespace mimicx::judge
