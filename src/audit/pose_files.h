/// `mimicx audit --poses`: the feasibility of whole data sets, a row per motion and, where asked for, per
/// frame.
///
/// Motions of our own layout stand where they stand. The floor of any other file is known to a few
/// centimetres at best, its body often not at all: it is moved up or down as a whole until the 5th percentile
/// of its lowest point is at z = 0, unless the user says where its floor is (`ReadConfig::floor`). The shift
/// is in the table.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "audit/pose_verdict.h"
#include "import/motion_file.h"

namespace mimicx::audit {

struct PoseFilesConfig {
  import::ReadConfig read;
  PoseNeedsConfig needs;
  bool frames = false;  ///< keep a row per frame
  int threads = 1;
};

struct PoseFile {
  std::string path;
  std::string failure;       ///< why it was left out, one line; empty: it was not
  double floor_shift = 0.0;  ///< by which it was moved up, m
  PoseVerdict verdict;
  PoseNeeds needs;  ///< without frames unless they were asked for
};

/// @return a file that cannot be judged is one with a failure
PoseFile judge_poses(const std::string& path, const PoseFilesConfig& config);
/// All files in parallel; `judged` gets them in their order, whatever the threads.
void judge_poses(const std::vector<std::string>& paths, const PoseFilesConfig& config,
                 const std::function<void(const PoseFile&)>& judged);

/// Lines that head the table, and a motion's.
std::string pose_table_head();
std::string format_poses(const PoseFile& file);

/// The first line of the CSV and a motion's: the verdict's values, longest stretch and joints in words. A
/// failed file has no numbers, and its reason in the last column.
std::string poses_csv_head();
std::string poses_csv_row(const PoseFile& file);
/// The same for frames, a line each.
std::string pose_frames_csv_head();
std::string pose_frames_csv_rows(const PoseFile& file);
/// {"files": [{file, failure, floor_shift_mm, summary, joints_over, words}]}
std::string poses_json(const std::vector<PoseFile>& files);

}  // namespace mimicx::audit
