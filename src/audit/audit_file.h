/// Files for `mimicx audit`: the contents of a file decide the kind of evidence. Also text and JSON of the
/// results.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "import/motion_file.h"

namespace mimicx::audit {

/// Physics steps: as recorded and replayed. A motion with forces: its frames. Any other: its poses alone.
/// Motions of every format that `convert` reads.
/// @param poses_alone  use only the poses, also of a motion with forces
/// @param read         of motions without forces
/// @throws DataError naming file and member, also if a motion has torques but not all other forces
std::vector<Audit> audit_file(const std::filesystem::path& path, bool poses_alone,
                              const import::ReadConfig& read = {});
/// The same from bytes in memory. @param path  for messages
std::vector<Audit> audit_bytes(const std::string& bytes, const std::filesystem::path& path, bool poses_alone,
                               const import::ReadConfig& read = {});

/// The frames of a motion whose file has its forces.
/// @param npz  the archive that the clip was read from
/// @throws DataError naming file and member
SimulatedFrames simulated_frames(const motion::Clip& clip, const Npz& npz);

/// `audit_frames` of them, with the gravity, friction and physics rate that they were simulated with.
Audit audit_recorded(const motion::Clip& clip, const Npz& npz);

struct AuditedFile {
  std::string path;
  std::vector<Audit> audits;
};

/// "physics steps", "replayed in double", "frames", "poses alone".
std::string evidence_name(Evidence evidence);
/// The table's heading, two lines; then a line per audit, and one more per failure.
std::string audit_table_head();
/// @param name  of the motion in the table
std::string format_audit(const std::string& name, const std::string& path, const Audit& audit);
/// {"files": [{file, audits: [{evidence, passed, failures, weight_N, rate, summary, rows: {…}}]}]}
std::string audit_json(const std::vector<AuditedFile>& files);

}  // namespace mimicx::audit
