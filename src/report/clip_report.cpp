#include "report/clip_report.h"

#include <algorithm>
#include <optional>

#include "audit/audit_file.h"
#include "audit/body_loads.h"
#include "audit/pose_files.h"
#include "audit/slip.h"
#include "core/npz/npz.h"
#include "core/units.h"
#include "files/archive_members.h"
#include "files/recorded_forces.h"
#include "motion/clip_file.h"
#include "motion/resample.h"
#include "record/feasibility_file.h"
#include "report/base64_digits.h"
#include "report/charts.h"

namespace mimicx::report {
namespace {

constexpr const char* kPhysics = "without reference";
constexpr const char* kReference = "against the prepared reference";
constexpr const char* kTruth = "against the truth";
constexpr const char* kTruthKey = "truth:";  ///< before the names of the metrics in that group
/// Mean unexplained force; of an input, by its poses alone.
constexpr const char* kRootForce = "root_force_mean_N";

bool needs_other(const motion::MetricDefinition& d) {
  using M = motion::Metrics;
  for (auto value :
       {&M::mrpe, &M::gmpjpe, &M::mpjpe, &M::pa_mpjpe, &M::vel, &M::accel, &M::fs_gt, &M::float_gt})
    if (d.value == value) return true;
  return false;
}

/// "options: 1 from frame 0, 3 from frame 42"
std::string arrangement_note(const std::vector<std::array<int, 2>>& arrangement) {
  std::string text = "options:";
  for (const auto& [frame, option] : arrangement)
    text +=
        (text.back() == ':' ? " " : ", ") + std::to_string(option) + " from frame " + std::to_string(frame);
  return text;
}

std::vector<ReportFact> facts_of(const record::SequenceEntry& entry) {
  std::vector<ReportFact> facts;
  for (const auto& [group, values] :
       {std::pair{"fit", &entry.fit}, std::pair{"preparation", &entry.preparation},
        std::pair{"feasibility", &entry.feasibility}, std::pair{"plan", &entry.plan},
        std::pair{"policy", &entry.policy}, std::pair{"audit", &entry.audit}})
    for (const auto& [name, value] : *values)
      facts.push_back({words_of_group(group), words_of_value(group, name), value});
  return facts;
}

/// A motion of the player with its curves.
struct Seen {
  ReportMotion motion;
  MeasuredMotion measured;
};

/// @param gravity  of the simulation, m/s²
/// @param forces   recorded with the clip at the same rate; none: the best ones for its poses
Seen seen(Who who, const motion::Clip& clip, double fps, double gravity,
          const std::optional<files::RecordedForces>& forces) {
  const motion::Clip at_rate = motion::resampled(clip, fps);
  Seen s{{who, motion::character_of(at_rate), motion::poses_of(at_rate), {}}, {}};
  const Character& character = s.motion.character;
  const PerFrame<BodyPoses>& poses = s.motion.poses;
  const audit::Slip slip =
      forces ? audit::slip_of(poses, forces->ground, gravity * character.total_mass(), fps, clip.scene)
             : audit::slip_of_poses(character, poses, fps, clip.scene, gravity);
  s.measured = measured(motion::sample_motion(character, poses, fps, clip.scene), slip.speed);
  for (const auto& surface : s.measured.samples.surface)
    s.motion.support.push_back(support_of(surface, clip.scene));
  return s;
}

/// Everything that the folder holds of a clip.
struct ClipFiles {
  std::optional<motion::Clip> input;  ///< runs of older versions have none
  motion::Clip cleaned;
  Npz members;  ///< of the cleaned motion
  std::vector<Seen> motions;

  const Seen* find(Who who) const {
    for (const Seen& s : motions)
      if (s.motion.who == who) return &s;
    return nullptr;
  }
};

ClipFiles read_files(const record::RunFolder& folder, const record::SequenceEntry& entry,
                     const TruthReader& read_truth, std::vector<std::string>& notes) {
  ClipFiles files;
  files.members = read_npz(folder.root / entry.output);
  files.cleaned = motion::clip_from(files.members, entry.name);
  const double gravity = files::recorded_gravity(files.cleaned);
  const auto add = [&](Who who, const motion::Clip& clip,
                       const std::optional<files::RecordedForces>& forces = std::nullopt) {
    files.motions.push_back(seen(who, clip, entry.fps, gravity, forces));
  };
  if (const auto input = folder.input(entry.name); std::filesystem::exists(input)) {
    files.input = motion::read_clip(input);
    add(Who::kInput, *files.input);
  }
  add(Who::kReference, motion::read_clip(folder.reference(entry.name)));
  add(Who::kCleaned, files.cleaned, files::recorded_forces(files.cleaned));
  if (!read_truth) return files;
  try {
    motion::Clip known = read_truth();
    known.scene = files.cleaned.scene;
    add(Who::kTruth, known);
  } catch (const std::exception& error) {
    notes.push_back(std::string("the truth cannot be shown: ") + error.what());
  }
  return files;
}

/// Input and cleaned motion against the truth.
void compare_with_truth(const ClipFiles& files, const std::vector<ReportMetric>& metrics, ReportRow& row,
                        std::vector<std::string>& notes) {
  const Seen* truth = files.find(Who::kTruth);
  if (!truth) return;
  const int known = truth->measured.samples.frames(),
            frames = files.find(Who::kReference)->measured.samples.frames();
  if (std::abs(known - frames) > 1) {
    notes.push_back("not compared with the truth: it has " + std::to_string(known) + " frames, the motion " +
                    std::to_string(frames));
    return;
  }
  for (const auto& [who, column] : {std::pair{Who::kInput, 0}, std::pair{Who::kCleaned, 2}}) {
    const Seen* motion = files.find(who);
    if (!motion) continue;
    const int frames = std::min(motion->measured.samples.frames(), truth->measured.samples.frames());
    const motion::MotionSamples same = head_of(truth->measured.samples, frames);
    const motion::Metrics m = motion::evaluate_motion(head_of(motion->measured.samples, frames), &same);
    for (std::size_t k = 0; k < metrics.size(); ++k)
      for (const motion::MetricDefinition& d : motion::metric_definitions())
        if (metrics[k].group == kTruth && metrics[k].key == kTruthKey + std::string(d.name))
          row.values[k][static_cast<std::size_t>(column)] = (m.*d.value).value;
  }
}

/// Unexplained forces: of the input by its poses, of the cleaned motion by its recorded forces.
struct Audits {
  std::optional<audit::PoseNeeds> input;
  std::optional<audit::Audit> cleaned;
};

Audits audits_of(const ClipFiles& files, double fps) {
  Audits audits;
  if (files.input)
    if (const motion::Clip clip = motion::resampled(*files.input, fps); clip.frames() > 2)
      audits.input = audit::needs_on_floor(clip);
  if (files.cleaned.has_simulated_body() && files.members.has("joint_torques") && files.cleaned.frames() > 1)
    audits.cleaned = audit::audit_recorded(files.cleaned, files.members);
  return audits;
}

/// A bar is full where the external force is half the weight, or the moment half the weight times a metre.
constexpr double kFullBar = 0.5;

ReportNeeds report_needs(const PerFrame<Vector6d>& wrenches, double mass) {
  ReportNeeds needs;
  for (const Vector6d& w : wrenches) {
    needs.force.push_back(w.tail<3>().norm());
    needs.acceleration.push_back(needs.force.back() / mass);
    needs.moment.push_back(w.head<3>().norm());
    const double most = std::max(needs.force.back(), needs.moment.back());
    needs.bar.push_back(std::min(1.0, most / (kFullBar * kGravity * mass)));
  }
  return needs;
}

/// Runs of older versions have no such file.
void add_feasibility(const std::filesystem::path& file, ReportClip& clip) {
  if (!std::filesystem::exists(file)) return;
  const record::FrameFeasibility all = record::read_feasibility(file);
  clip.needs = report_needs(all.need, all.mass);
  clip.wrong = all.wrong;
  clip.assistance = report_needs(all.assistance, all.mass);
}

void add_ground(const ClipFiles& files, ReportClip& clip) {
  if (!files.members.has("ground_wrenches")) return;
  const ReportMotion& cleaned = files.find(Who::kCleaned)->motion;
  const files::WrenchRows wrenches =
      files::read_wrenches(files.members, "ground_wrenches", cleaned.poses.size());
  for (std::size_t t = 0; t < wrenches.size(); ++t)
    clip.ground.push_back(files::floor_arrows(wrenches[t], cleaned.poses[t], files.cleaned.scene));
  clip.weight = files::recorded_gravity(files.cleaned) * cleaned.character.total_mass();
}

/// Runs of older versions have no such members.
PerFrame<audit::LoadSharing> sharing_of(const ClipFiles& files) {
  if (!files.members.has("foot_force_least")) return {};
  return audit::read_sharing(files.members, static_cast<std::size_t>(files.cleaned.frames()));
}

/// Torques of the controllers alone, without those of the joint limits.
void add_torques(const ClipFiles& files, ReportClip& clip) {
  if (!files.members.has("joint_torques") || !files.members.has("range_torques")) return;
  const ReportMotion& cleaned = files.find(Who::kCleaned)->motion;
  files::VectorRows torques = files::read_joints(files.members, "joint_torques", cleaned.poses.size());
  const files::VectorRows range = files::read_joints(files.members, "range_torques", cleaned.poses.size());
  for (std::size_t t = 0; t < torques.size(); ++t) {
    for (int b = 0; b < kBodies; ++b) torques[t][b] -= range[t][b];
    clip.torques.push_back(audit::torque_shares(cleaned.character, torques[t]));
  }
}

/// The input's camera, if the clip was cleaned with another one.
std::optional<PlacedCamera> told_camera(const ClipFiles& files, const PlacedCamera& placed, double fps) {
  if (!files.input || !files.input->keypoints) return std::nullopt;
  const motion::Keypoints told = *motion::resampled(*files.input, fps).keypoints;
  const bool same = told.intrinsics == placed.intrinsics && told.extrinsics == placed.extrinsics;
  if (told.extrinsics.empty() || same) return std::nullopt;
  return PlacedCamera{told.intrinsics, told.extrinsics};
}

void add_camera(const ClipFiles& files, ReportClip& clip) {
  clip.camera = camera_of(motion::resampled(files.cleaned, clip.fps));
  if (!clip.camera) return;
  clip.camera->told = told_camera(files, clip.camera->placed, clip.fps);
  ReportChart chart{
      {"distance from the keypoints", "px",
       "mean distance from the detected keypoints, weighted by their confidence: of the cleaned "
       "motion and the reference through the clip's camera, of the input through the camera of "
       "its file"},
      {}};
  for (const Seen& s : files.motions) {
    const bool own = s.motion.who == Who::kInput && clip.camera->told;
    chart.lines.push_back(
        {s.motion.who, title_of(s.motion.who),
         distances_from_seen(*clip.camera, own ? *clip.camera->told : clip.camera->placed, s.motion.poses)});
  }
  chart.step = 1.0 / clip.fps;
  clip.charts.push_back(chart);
}

/// The option of every stretch of frames.
std::vector<ReportStretch> stretches_of(const record::SequenceEntry& entry) {
  std::vector<ReportStretch> stretches;
  for (const auto& [frame, option] : entry.arrangement) {
    if (!stretches.empty()) stretches.back().last = frame - 1;
    stretches.push_back({frame, entry.frames - 1, option});
  }
  return stretches;
}

/// Whether policies were trained for the motion, even if the plan was written in the end.
bool was_trained(const record::SequenceEntry& entry) { return entry.method != "plan" || entry.samples > 0; }

void add_motions(const record::RunFolder& folder, const record::SequenceEntry& entry,
                 const std::vector<ReportMetric>& metrics, const TruthReader& read_truth,
                 ReportedClip& made) {
  ReportClip& clip = made.clip;
  const ClipFiles files = read_files(folder, entry, read_truth, clip.notes);
  compare_with_truth(files, metrics, made.row, clip.notes);
  const Audits audits = audits_of(files, entry.fps);
  for (std::size_t k = 0; k < metrics.size(); ++k)
    if (metrics[k].key == kRootForce && audits.input)
      made.row.values[k][0] = value_of(audit::verdict_on(*audits.input).values, "force_mean_N");
  clip.scene = files.cleaned.scene;
  add_ground(files, clip);
  add_torques(files, clip);
  clip.options = stretches_of(entry);
  ChartSources sources;
  for (const Seen& s : files.motions) sources.motions.emplace_back(s.motion.who, &s.measured);
  sources.needs_of_input = audits.input ? &*audits.input : nullptr;
  sources.audit_of_cleaned = audits.cleaned ? &*audits.cleaned : nullptr;
  sources.ground = &clip.ground;
  const PerFrame<audit::LoadSharing> sharing = sharing_of(files);
  sources.sharing = &sharing;
  sources.weight = clip.weight;
  sources.members = &files.members;
  clip.charts = charts_of(sources);
  add_camera(files, clip);
  const Seen* input = files.find(Who::kInput);
  clip.bars = bars_of(input ? &input->measured : nullptr, files.find(Who::kCleaned)->measured, clip.ground,
                      clip.weight);
  if (!entry.parts.empty()) {
    ReportBars bars{"followed in part", "these frames are motions of their own", false, {}};
    for (const auto& [first, last] : entry.parts) bars.spans.push_back({first, last});
    clip.bars.push_back(bars);
  }
  for (const record::Worsening& worse : entry.worse) {
    ReportBars bars{
        "more " + worse.measure, "worse than the input, " + worse.numbers + ": " + worse.why, true, {}};
    for (const auto& [first, last] : worse.frames) bars.spans.push_back({first, last});
    clip.bars.push_back(bars);
  }
  for (const Seen& s : files.motions) clip.motions.push_back(s.motion);
  add_feasibility(folder.feasibility(entry.name), clip);
  if (!was_trained(entry)) return;
  if (const auto log = folder.log(entry.name); std::filesystem::exists(log))
    clip.training = training_charts(record::read_csv(log));
  if (const auto falls = folder.falls(entry.name); std::filesystem::exists(falls))
    clip.charts.push_back(falls_chart(record::read_csv(falls), entry.fps));
}

}  // namespace

std::vector<ReportMetric> report_metrics(bool truth) {
  std::vector<ReportMetric> metrics;
  Words force = words_of_value("audit", kRootForce);
  force.meaning =
      "external force that is still needed: for the input, beyond the best floor forces that its poses "
      "allow; "
      "for the cleaned motion, beyond its recorded forces";
  metrics.push_back({kRootForce, force, kPhysics});
  for (const char* name :
       {"slip", "slip_share", "Float", "GP", "Jitter", "chatter", "FS", "SelfPen", "GP_max", "FS_0"})
    metrics.push_back({name, words_of_metric(name), kPhysics});
  const auto have = [&metrics](const std::string& key) {
    return std::any_of(metrics.begin(), metrics.end(), [&](const auto& m) { return m.key == key; });
  };
  for (const motion::MetricDefinition& d : motion::metric_definitions()) {
    if (truth && needs_other(d))
      metrics.push_back({std::string(kTruthKey) + d.name, words_of_metric(d.name), kTruth});
  }
  for (const motion::MetricDefinition& d : motion::metric_definitions())
    if (!have(d.name)) metrics.push_back({d.name, words_of_metric(d.name), kReference});
  metrics.push_back({"max_distance_mm", words_of_metric("max_distance_mm"), kReference});
  for (ReportMetric& m : metrics)  // the run's own metrics take the prepared reference as the truth
    if (m.group != kTruth)
      for (std::size_t at = 0; (at = m.words.meaning.find("truth", at)) != std::string::npos;)
        m.words.meaning.replace(at, 5, "prepared reference");
  return metrics;
}

ReportRow report_row(const record::SequenceEntry& entry, const std::vector<ReportMetric>& metrics) {
  ReportRow row;
  row.name = entry.name;
  row.ok = entry.ok;
  row.reason = entry.reason;
  row.made_by = words_of_method(entry.method);
  row.frames = entry.frames;
  row.seconds = entry.fps > 0.0 ? entry.frames / entry.fps : 0.0;
  row.reward = entry.reward_after;
  for (const ReportMetric& m : metrics)
    row.values.push_back({value_of(entry.input_metrics, m.key), value_of(entry.metrics_before, m.key),
                          value_of(m.key == kRootForce ? entry.audit : entry.metrics, m.key)});
  return row;
}

ReportedClip report_clip(const record::RunFolder& folder, const record::SequenceEntry& entry,
                         const std::vector<ReportMetric>& metrics, const TruthReader& read_truth) {
  const auto plain = [&] {
    ReportedClip made{report_row(entry, metrics), {}};
    made.clip.fps = entry.fps > 0.0 ? entry.fps : made.clip.fps;
    made.clip.facts = facts_of(entry);
    made.clip.notes = entry.notes;
    if (!entry.parts.empty()) made.clip.notes.push_back(parts_in_words(entry));
    for (const record::Worsening& worse : entry.worse)
      made.clip.notes.push_back("worse than the input: " + in_words(worse));
    if (!entry.arrangement.empty()) made.clip.notes.push_back(arrangement_note(entry.arrangement));
    return made;
  };
  ReportedClip made = plain();
  if (entry.output.empty()) return made;
  try {
    add_motions(folder, entry, metrics, read_truth, made);
    return made;
  } catch (const std::exception& error) {
    made = plain();
    made.clip.notes.push_back(std::string("cannot be shown: ") + error.what());
    return made;
  }
}

}  // namespace mimicx::report
