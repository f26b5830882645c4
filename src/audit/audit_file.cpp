#include "audit/audit_file.h"

#include "audit/audit_summary.h"
#include "core/number_text.h"
#include "files/archive_members.h"
#include "files/recorded_forces.h"
#include "motion/clip_file.h"
#include "record/json.h"

namespace mimicx::audit {
namespace {

record::Json to_json(const Audit& audit) {
  record::Json rows = {{"index", record::Json::array()},          {"root_force_N", record::Json::array()},
                       {"root_moment_Nm", record::Json::array()}, {"torque_gap_Nm", record::Json::array()},
                       {"torque_share", record::Json::array()},   {"power_W", record::Json::array()}};
  for (const AuditRow& row : audit.rows) {
    rows["index"].push_back(row.index);
    rows["root_moment_Nm"].push_back(
        {record::number(row.root[0]), record::number(row.root[1]), record::number(row.root[2])});
    rows["root_force_N"].push_back(
        {record::number(row.root[3]), record::number(row.root[4]), record::number(row.root[5])});
    rows["torque_gap_Nm"].push_back(record::number(row.torque_gap));
    rows["torque_share"].push_back(record::number(row.torque_share));
    rows["power_W"].push_back(record::number(row.power));
  }
  return {{"evidence", evidence_name(audit.evidence)},
          {"passed", audit.failures.empty()},
          {"failures", audit.failures},
          {"weight_N", audit.weight},
          {"rows_per_second", audit.rate},
          {"summary", record::to_json(summary_of(audit))},
          {"rows", rows}};
}

/// Whether files are read as other motions than they hold.
bool changes_motions(const import::ReadConfig& read) {
  return read.up || read.scale || read.fps || read.floor || read.mass || read.height || read.standard_body;
}

}  // namespace

SimulatedFrames simulated_frames(const motion::Clip& clip, const Npz& npz) {
  if (!clip.has_simulated_body())
    throw DataError(npz.path, "body_model", "'mimicx', or rest_joints, beside joint_torques",
                    "'" + clip.body_model + "'");
  SimulatedFrames motion;
  motion.character = motion::character_of(clip);
  motion.fps = clip.fps;
  motion.scene = clip.scene;
  const Vector3d pelvis = motion::rest_pelvis(clip);
  const auto rotations = motion::joint_rotations(clip);
  const std::size_t rows = rotations.size();
  for (std::size_t t = 0; t < rows; ++t) {
    motion::ReferenceFrame frame;
    frame.p_root = clip.trans[t] + pelvis;
    frame.q = rotations[t];
    motion.frames.push_back(frame);
  }
  files::read_velocities(npz, "velocities", motion.frames);
  const files::VectorRows torques = files::read_joints(npz, "joint_torques", rows),
                          ranges = files::read_joints(npz, "range_torques", rows);
  const files::WrenchRows ground = files::read_wrenches(npz, "ground_wrenches", rows),
                          self = files::read_wrenches(npz, "self_contact_wrenches", rows);
  for (std::size_t t = 0; t < rows; ++t) motion.forces.push_back({torques[t], ranges[t], ground[t], self[t]});
  return motion;
}

Audit audit_recorded(const motion::Clip& clip, const Npz& npz) {
  return audit_frames(simulated_frames(clip, npz), files::recorded_simulation(clip));
}

std::vector<Audit> audit_file(const std::filesystem::path& path, bool poses_alone,
                              const import::ReadConfig& read) {
  return audit_bytes(read_file(path), path, poses_alone, read);
}

std::vector<Audit> audit_bytes(const std::string& bytes, const std::filesystem::path& path, bool poses_alone,
                               const import::ReadConfig& read) {
  if (import::recognise(bytes) == import::MotionFormat::kNpz) {
    const Npz npz = parse_npz(bytes, path.string());
    const bool steps = holds_substeps(npz), forces = steps || (npz.has("joint_torques") && !poses_alone);
    if (forces && read.scene)
      throw DataError(path.string(), "--scene", "none: the file's forces were made on its own scene", "one");
    if (forces && changes_motions(read))
      throw DataError(path.string(), "",
                      "no other reading: the file's forces were made with the motion as it is", read.text());
    if (steps) {
      const SubstepMotion motion = read_substeps(npz);
      return {audit_steps(motion), audit_replayed_steps(motion)};
    }
    if (forces) return {audit_recorded(motion::clip_from(npz, path.stem().string()), npz)};
  }
  const motion::Clip clip = import::motion_from(bytes, path, read);
  if (clip.frames() < 3)
    throw DataError(path.string(), "", "at least 3 frames", std::to_string(clip.frames()));
  return {audit_poses(clip)};
}

std::string evidence_name(Evidence evidence) {
  constexpr Array<const char*, 4> kNames = {"physics steps", "replayed in double", "frames", "poses alone"};
  return kNames[static_cast<int>(evidence)];
}

std::string audit_table_head() {
  return formatted("%-28s %-18s %22s %24s %15s %12s %13s %9s\n%-28s %-18s %22s %24s %15s %12s %13s %9s\n",
                   "motion", "evidence", "unexplained root force", "unexplained root moment", "joint torque",
                   "friction", "", "work", "", "", "mean     max at", "mean      max at", "gap  bound",
                   "beyond", "pull   air", "+ J");
}

std::string format_audit(const std::string& name, const std::string& path, const Audit& audit) {
  const NamedValues values = summary_of(audit);
  const auto value = [&](const char* key) { return value_of(values, key); };
  std::string line =
      formatted("%-28s %-18s %9.3g %7.4g N %5.0f %8.3g %7.3g N·m %4.0f", name.c_str(),
                evidence_name(audit.evidence).c_str(), value("root_force_mean_N"), value("root_force_max_N"),
                value("root_force_worst"), value("root_moment_mean_Nm"), value("root_moment_max_Nm"),
                value("root_moment_worst"));
  if (audit.evidence != Evidence::kPosesAlone)
    line += formatted(" %8.3g %4.0f %% %10.2g %% %6.2g %4.2g %% %9.0f", value("torque_gap_mean_Nm"),
                      100.0 * value("torque_worst_share"), value("beyond_cone_percent"),
                      value("pull_percent"), value("in_air_percent"), value("work_positive_J"));
  line += "\n";
  for (const std::string& failure : audit.failures) line += "  FAILS: " + path + ": " + failure + "\n";
  return line;
}

std::string audit_json(const std::vector<AuditedFile>& files) {
  record::Json list = record::Json::array();
  for (const AuditedFile& file : files) {
    record::Json audits = record::Json::array();
    for (const Audit& audit : file.audits) audits.push_back(to_json(audit));
    list.push_back({{"file", file.path}, {"audits", audits}});
  }
  return record::document(record::Json({{"files", list}}));
}

}  // namespace mimicx::audit
