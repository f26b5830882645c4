#include "audit/pose_files.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/number_text.h"
#include "core/parallel.h"
#include "core/quantile.h"
#include "core/units.h"
#include "files/recorded_forces.h"
#include "record/json.h"

namespace mimicx::audit {
namespace {

constexpr double kFloorShare = 0.05;  ///< share of frames whose lowest point may be under the floor
constexpr int kBatch = 64;            ///< files between two reports

/// The upward shift that puts a motion onto the ground, m.
double shift_to_floor(const Character& c, const PerFrame<BodyPoses>& poses, const Scene& scene) {
  std::vector<double> lowest;
  for (const BodyPoses& frame : poses) lowest.push_back(lowest_contact(c, frame, scene));
  return -quantile(std::move(lowest), kFloorShare);
}

/// The poses, moved to the floor where it is not known, and their upward shift, m.
std::pair<PerFrame<BodyPoses>, double> on_floor(const Character& c, const motion::Clip& clip) {
  PerFrame<BodyPoses> poses = motion::poses_of(clip);
  if (clip.body_model == "mimicx" || clip.is_simulated() || clip.on_floor) return {poses, 0.0};
  const double shift = shift_to_floor(c, poses, clip.scene);
  for (BodyPoses& frame : poses)
    for (Vector3d& p : frame.p_WB) p.z() += shift;
  return {poses, shift};
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

/// A text as a field of a CSV (RFC 4180).
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : one_line(text)) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

/// Six digits: poses are not more accurate.
std::string number(double value) { return std::isfinite(value) ? formatted("%.6g", value) : ""; }

/// Names of the verdict's values, in their order.
std::vector<std::string> value_names() {
  PoseNeeds one;
  one.frames.resize(1);
  std::vector<std::string> names;
  for (const auto& [name, value] : verdict_on(one).values) names.push_back(name);
  return names;
}

/// The joint with the largest share of its bound.
int weakest_joint(const PoseNeed& need) {
  return static_cast<int>(std::max_element(need.torque.begin(), need.torque.end()) - need.torque.begin());
}

}  // namespace

PoseNeeds needs_on_floor(const motion::Clip& clip) {
  const Character character = motion::character_of(clip);
  return needs_of_poses(character, on_floor(character, clip).first, clip.fps, {}, clip.scene);
}

PoseFile audit_pose_file(const std::string& path, const PoseFilesConfig& config) {
  PoseFile file;
  file.path = path;
  try {
    const motion::Clip clip = import::read_motion(path, config.read);
    file.told = import::notable_decisions(path, clip);
    motion::require_usable(clip, 3);
    const Character character = motion::character_of(clip);
    const auto [poses, shift] = on_floor(character, clip);
    file.floor_shift = shift;
    const physics::SimulationConfig simulation = files::recorded_simulation(clip);
    PoseNeedsConfig needs;
    needs.reach = config.reach;
    needs.friction = simulation.friction;
    needs.gravity = simulation.gravity;
    file.needs = needs_of_poses(character, poses, clip.fps, needs, clip.scene);
    file.verdict = verdict_on(file.needs);
    file.slip = slip_of_clip(clip, simulation.gravity);
    file.slip.speed.clear();
    if (!config.frames) file.needs.frames.clear();
  } catch (const std::exception& error) {
    file.failure = one_line(error.what());
  }
  return file;
}

void audit_pose_files(const std::vector<std::string>& paths, const PoseFilesConfig& config,
                      const std::function<void(const PoseFile&)>& judged) {
  const List<std::string> all(paths);
  for (int begin = 0; begin < all.count(); begin += kBatch) {
    List<PoseFile> files(std::min(kBatch, all.count() - begin));
    parallel_for(files.count(), config.threads,
                 [&](int i) { files[i] = audit_pose_file(all[begin + i], config); });
    for (const PoseFile& file : files) judged(file);
  }
}

std::string pose_table_head() {
  return formatted("%-28s %6s %16s %18s %10s  %s\n%-28s %6s %7s %8s %9s %8s %10s\n", "motion", "frames",
                   "force, N", "moment, N m", "infeasible", "longest stretch", "", "", "mean", "max", "mean",
                   "max", "%");
}

std::string format_poses(std::string name, const PoseFile& file) {
  const auto value = [&](const char* key) { return value_of(file.verdict.values, key); };
  const std::string numbers = formatted(" %6.0f %7.1f %8.1f %9.2f %8.1f %10.1f  ", value("frames"),
                                        value("force_mean_N"), value("force_max_N"), value("moment_mean_Nm"),
                                        value("moment_max_Nm"), 100.0 * value("infeasible_share"));
  name.resize(std::max<std::size_t>(name.size(), 28), ' ');
  std::string line = name + numbers + file.verdict.words;
  if (!file.verdict.over_in_words.empty())
    line += "; torques over their bounds, frames: " + file.verdict.over_in_words;
  return line + '\n';
}

std::string poses_csv_head() {
  std::string line = "file,floor_shift_mm";
  for (const std::string& name : value_names()) line += ',' + name;
  return line + ",slip,slip_share,longest_wrong,joints_over,words\n";
}

std::string poses_csv_row(const PoseFile& file) {
  const bool good = file.failure.empty();
  std::string line = field(file.path) + ',' + (good ? number(kMm * file.floor_shift) : "");
  for (const std::string& name : value_names()) line += ',' + number(value_of(file.verdict.values, name));
  line += ',' + number(file.slip.mean) + ',' + number(file.slip.share);
  line += ',' + (good ? std::string(name_of(file.verdict.longest.wrong)) : "left out");
  return line + ',' + file.verdict.joints_over + ',' + field(good ? file.verdict.words : file.failure) + '\n';
}

std::string pose_frames_csv_head() {
  return "file,frame,seconds,force_x_N,force_y_N,force_z_N,force_N,accel_m_s2,moment_x_Nm,moment_y_Nm,"
         "moment_z_Nm,moment_Nm,wrong,floor_N,points,lowest_mm,torque_share,torque_joint\n";
}

std::string pose_frames_csv_rows(const PoseFile& file) {
  std::string lines;
  const std::string name = field(file.path);
  for (int t = 0; t < file.needs.frames.count(); ++t) {
    const PoseNeed& need = file.needs.frames[t];
    const int joint = weakest_joint(need);
    lines += name + ',' + std::to_string(t) + ',' + number(t / file.needs.fps);
    for (const double value : {need.force.x(), need.force.y(), need.force.z(), need.force.norm(),
                               need.force.norm() / file.needs.mass, need.moment.x(), need.moment.y(),
                               need.moment.z(), need.moment.norm()})
      lines += ',' + number(value);
    lines += ',' + std::string(name_of(wrong_with(need, file.needs.weight)));
    lines += ',' + number(need.floor) + ',' + std::to_string(need.points) + ',' + number(kMm * need.lowest);
    lines += ',' + number(need.torque[joint]) + ',' + std::string(kBodyNames[joint]) + '\n';
  }
  return lines;
}

std::string poses_json(const std::vector<PoseFile>& files) {
  record::Json list = record::Json::array();
  for (const PoseFile& file : files) {
    record::Json summary = record::to_json(file.verdict.values);
    summary["slip"] = record::number(file.slip.mean);
    summary["slip_share"] = record::number(file.slip.share);
    list.push_back({{"file", file.path},
                    {"failure", file.failure},
                    {"floor_shift_mm", kMm * file.floor_shift},
                    {"summary", summary},
                    {"joints_over", file.verdict.joints_over},
                    {"words", file.verdict.words}});
  }
  return record::document(record::Json({{"files", list}}));
}

}  // namespace mimicx::audit
