/// Files for `mimicx audit`: what each holds decides the evidence; text and JSON of the results.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "import/motion_file.h"

namespace mimicx::audit {

/// Physics steps: as recorded and replayed. A motion with forces: its frames. Any other: its poses alone.
/// Motions of every format that `convert` reads.
/// @param poses_alone  look at nothing but the poses, whatever a motion holds besides
/// @param read         of motions without forces
/// @throws DataError naming file and member, also where a motion has torques but not all that belongs to them
std::vector<Audit> audit_file(const std::filesystem::path& path, bool poses_alone,
                              const import::ReadConfig& read = {});
/// The same from bytes in memory. @param path  for messages
std::vector<Audit> audit_bytes(const std::string& bytes, const std::filesystem::path& path, bool poses_alone,
                               const import::ReadConfig& read = {});

/// A motion that has its forces beside it.
/// @param npz  the archive that the clip was read from
/// @throws DataError naming file and member
SimulatedFrames simulated_frames(const motion::Clip& clip, const Npz& npz);

struct AuditedFile {
  std::string path;
  std::vector<Audit> audits;
};

/// "physics steps", "replayed in double", "frames", "poses alone".
std::string evidence_name(Evidence evidence);
/// Two lines that head the table; a line per audit, and one more per failure.
std::string audit_table_head();
std::string format_audit(const std::string& path, const Audit& audit);
/// {"files": [{file, audits: [{evidence, passed, failures, weight_N, rate, summary, rows: {…}}]}]}
std::string audit_json(const std::vector<AuditedFile>& files);

}  // namespace mimicx::audit
