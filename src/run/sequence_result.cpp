#include "run/sequence_result.h"

#include <system_error>

#include "audit/audit.h"
#include "audit/audit_summary.h"
#include "audit/load_sharing/load_sharing.h"
#include "audit/pose_verdict.h"
#include "audit/substeps.h"
#include "files/motion_output.h"
#include "judge/reference_needs.h"
#include "judge/worsening.h"
#include "motion/clip_file.h"

namespace mimicx::run {
namespace {

audit::SimulatedFrames frames_of(const motion::Reference& reference,
                                 const rl::tracking::TrackingRollout& rollout) {
  audit::SimulatedFrames motion{reference.character, reference.fps, {}, rollout.forces, reference.scene};
  for (const auto& pose : rollout.poses) motion.frames.push_back(pose.frame);
  return motion;
}

/// Writes into the entry whether the recorded forces explain the motion.
void audit_sequence(const motion::Reference& reference, const physics::SimulationConfig& simulation,
                    const rl::tracking::TrackingRollout& rollout, record::SequenceEntry& entry) {
  const audit::Audit audit = audit::audit_frames(frames_of(reference, rollout), simulation);
  entry.audit = audit::summary_of(audit);
  for (const std::string& failure : audit.failures) entry.notes.push_back("audit: " + failure);
}

void write_simulated_motion(const std::filesystem::path& path, const motion::Clip& input,
                            const motion::Reference& reference, const rl::tracking::TrackingRollout& rollout,
                            const physics::SimulationConfig& simulation) {
  const auto sharing = audit::load_sharing(frames_of(reference, rollout), {.friction = simulation.friction});
  files::Members members = audit::sharing_members(sharing);
  for (auto& member : files::simulation_members(simulation, reference.character.total_mass()))
    members.push_back(std::move(member));
  files::write_simulated(path, input, reference, rollout, members);
}

std::filesystem::path with_parents(const std::filesystem::path& file) {
  make_folder(file.parent_path());
  return file;
}

/// Writes the parts and removes those of an earlier result.
void write_parts(const record::RunFolder& folder, const motion::Clip& input, const List<FollowedPart>& parts,
                 const physics::SimulationConfig& simulation, record::SequenceEntry& entry) {
  for (int k = 1; k <= record::kMostParts; ++k) std::filesystem::remove(folder.part(entry.name, k));
  motion::Clip body = input;  // members of the input begin at its first frame: parts have none
  body.passthrough.clear();
  entry.parts.clear();
  for (const FollowedPart& part : parts) {
    entry.parts.push_back({part.first, part.first + part.reference.size() - 1});
    write_simulated_motion(with_parents(folder.part(entry.name, static_cast<int>(entry.parts.size()))), body,
                           part.reference, part.rollout, simulation);
  }
}

/// Checksums of a sequence's present files, by their names in the folder. Not of checkpoints, which a
/// finished motion no longer needs, nor of physics steps and gains, which a later command may add.
record::FileChecksums checksums_of(const record::RunFolder& folder, const record::SequenceEntry& entry) {
  record::FileChecksums files;
  for (const std::filesystem::path& file : folder.files_of(entry.name)) {
    if (file == folder.checkpoint(entry.name) || file == folder.substeps(entry.name) ||
        file == folder.gains(entry.name))
      continue;
    if (const std::string checksum = record::checksum_or_none(file); !checksum.empty())
      files.emplace_back(file.lexically_relative(folder.root).generic_string(), checksum);
  }
  return files;
}

}  // namespace

void remove_result(const record::RunFolder& folder, const record::SequenceEntry& entry) {
  std::error_code ignored;
  const std::filesystem::path motion = folder.root / entry.output;
  if (entry.output.empty() || !std::filesystem::exists(motion, ignored)) return;
  for (const std::filesystem::path& file : folder.files_of(entry.name))
    if (file != motion) std::filesystem::remove(file, ignored);
  std::filesystem::remove(motion, ignored);
}

void judge_reference(const audit::PoseNeeds& needs, record::SequenceEntry& entry) {
  if (needs.frames.empty()) return;
  const audit::PoseVerdict verdict = audit::verdict_on(needs);
  entry.feasibility = verdict.values;
  if (verdict.longest.wrong != audit::Wrong::kNothing)
    entry.notes.push_back("the reference is not feasible: " + verdict.words);
}

void judge_sequence(const JudgedMotion& motion, const physics::SimulationConfig& simulation,
                    const SimulatedSequence& made, record::SequenceEntry& entry) {
  const motion::Reference& reference = motion.reference;
  entry.method = made.method;
  entry.plan = made.plan;
  entry.policy = made.policy;
  append(entry.feasibility, judge::assistance_values(made.assistance, reference.character.total_mass()));
  entry.samples = made.samples;
  entry.ending = made.ending;
  entry.training_ending = made.training_ending;
  entry.arrangement = made.arrangement;
  entry.notes.insert(entry.notes.end(), made.notes.begin(), made.notes.end());
  if (made.before) {
    const judge::Scores before = judge::score_simulated(reference, *made.before);
    entry.reward_before = made.before->mean_reward;
    entry.metrics_before = before.values;
    entry.ok_before = before.success;
  }
  const judge::Scores after = judge::score_simulated(reference, made.after);
  entry.reward_after = made.after.mean_reward;
  entry.metrics = after.values;
  entry.ok = after.success;
  entry.reason = after.reason;
  if (entry.ok)
    entry.worse = judge::worsenings({motion.input, reference, motion.needs, motion.input_scores}, made.after,
                                    entry.metrics);
  if (!made.reason.empty()) {
    if (entry.ok)
      entry.notes.push_back(made.reason);
    else
      entry.reason = made.reason + "; " + after.reason;
  }
  audit_sequence(reference, simulation, made.after, entry);
}

void write_sequence(const RunState& run, const JudgedMotion& motion, const SimulatedSequence& made,
                    const List<FollowedPart>& parts, record::SequenceEntry& entry) {
  const record::RunFolder& folder = run.folder;
  files::write_input(with_parents(folder.input(entry.name)), motion.input);
  if (motion.has_fit)
    motion::write_clip(with_parents(folder.fit(entry.name)), motion.fitted);
  else
    std::filesystem::remove(folder.fit(entry.name));
  files::write_reference(with_parents(folder.reference(entry.name)), motion.input, motion.reference);
  if (!motion.needs.frames.empty())
    record::write_feasibility(with_parents(folder.feasibility(entry.name)),
                              judge::frame_feasibility(motion.needs, made.assistance));
  const std::string output = record::RunFolder::motion_name(entry.name, entry.ok);
  std::filesystem::remove(folder.root / record::RunFolder::motion_name(entry.name, !entry.ok));
  write_simulated_motion(with_parents(folder.root / output), motion.input, motion.reference, made.after,
                         run.method.simulation);
  write_parts(folder, motion.input, parts, run.method.simulation, entry);
  if (made.after.substeps.empty())
    std::filesystem::remove(folder.substeps(entry.name));
  else
    audit::write_substeps(with_parents(folder.substeps(entry.name)),
                          {motion.reference.character, run.method.simulation, made.after.substeps,
                           made.after.last_state, motion.reference.scene, motion.input.rest_joints});
  std::filesystem::remove(folder.policy(entry.name));
  if (made.taught) files::write_policy(with_parents(folder.policy(entry.name)), motion.input, *made.taught);
  entry.output = output;
  entry.files = checksums_of(folder, entry);
}

std::vector<std::string> damaged_files(const record::RunFolder& folder, const record::SequenceEntry& entry) {
  std::vector<std::string> damaged;
  for (const auto& [name, checksum] : entry.files)
    if (record::checksum_or_none(folder.root / name) != checksum) damaged.push_back(name);
  return damaged;
}

}  // namespace mimicx::run
