/// `mimicx audit --poses`: the feasibility of whole data sets, a row per motion and, where asked for, per
/// frame.
///
/// Simulated motions and those of our body are not moved: those of our own layout, and those of other
/// skeletons, which reading puts onto the floor. In any other file the floor is known to a few centimetres at
/// best, and the body often not at all: the whole motion is shifted up or down until the 5th percentile of
/// its lowest point is at z = 0, unless the user gives the floor (`ReadConfig::floor`). The shift is in the
/// table.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "audit/pose_verdict.h"
#include "audit/slip.h"
#include "import/motion_file.h"

namespace mimicx::audit {

struct PoseFilesConfig {
  import::ReadConfig read;
  double reach = PoseNeedsConfig().reach;  ///< as there; friction and gravity are those that the file records
  bool frames = false;                     ///< keep a row per frame
  int threads = 1;
};

struct PoseFile {
  std::string path;
  std::string failure;            ///< why it was skipped, one line; empty: it was judged
  std::vector<std::string> told;  ///< what the reader decided (import::notable_decisions)
  double floor_shift = 0.0;       ///< upward shift, m
  PoseVerdict verdict;
  PoseNeeds needs;  ///< without frames unless requested
  Slip slip;        ///< with the best floor forces, as `mimicx evaluate` has it; without speeds
};

/// The needs of a motion, moved to the floor as above. @throws std::invalid_argument as `needs_of_poses`
PoseNeeds needs_on_floor(const motion::Clip& clip);

/// @return with a failure if the file cannot be judged
PoseFile audit_pose_file(const std::string& path, const PoseFilesConfig& config);
/// Judges all files in parallel; `judged` gets the results in the order of `paths` for any number of threads.
void audit_pose_files(const std::vector<std::string>& paths, const PoseFilesConfig& config,
                      const std::function<void(const PoseFile&)>& judged);

/// The table's heading, and the line of a motion by a name.
std::string pose_table_head();
std::string format_poses(std::string name, const PoseFile& file);

/// The heading of the CSV, and the row of a motion: the verdict's values, its longest stretch and joints in
/// words. A failed file has no numbers, and the reason in the last column.
std::string poses_csv_head();
std::string poses_csv_row(const PoseFile& file);
/// The same for frames, a line each.
std::string pose_frames_csv_head();
std::string pose_frames_csv_rows(const PoseFile& file);
/// {"files": [{file, failure, floor_shift_mm, summary, joints_over, words}]}
std::string poses_json(const std::vector<PoseFile>& files);

}  // namespace mimicx::audit
