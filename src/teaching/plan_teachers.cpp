#include "teaching/plan_teachers.h"

#include "files/plan_file.h"
#include "files/simulation_settings.h"
#include "motion/clip_file.h"
#include "record/manifest.h"

namespace mimicx::teaching {
namespace {

motion::Reference reference_in(const PlannedMotion& motion, const files::StoredPlan& stored) {
  motion::Reference body;
  body.name = motion.name;
  body.fps = stored.fps;
  const motion::Clip clip = motion::read_clip(motion.run.reference(motion.name));
  body.character = motion::character_of(clip);
  body.scene = clip.scene;
  return rl::tracking::reference_of_states(body, stored.reference);
}

/// @param reference  what was planned for
motion::Reference planned_reference(const motion::Reference& reference, const files::StoredPlan& stored) {
  return rl::tracking::reference_of_states(reference, stored.plan.states);
}

void require_simulation(const std::filesystem::path& file, const physics::SimulationConfig& there,
                        const physics::SimulationConfig& here) {
  const NamedValues found = files::simulation_numbers(there), expected = files::simulation_numbers(here);
  for (std::size_t k = 0; k < found.size(); ++k)
    if (found[k] != expected[k])
      throw DataError(file.string(), found[k].first, std::to_string(expected[k].second),
                      std::to_string(found[k].second));
}

}  // namespace

std::vector<PlannedMotion> planned_motions(const record::RunFolder& run) {
  std::vector<PlannedMotion> motions;
  for (const record::SequenceEntry& entry : record::read_manifest(run.manifest()).sequences) {
    if (!std::filesystem::exists(run.plan(entry.name))) continue;
    PlannedMotion motion{run, entry.name, entry.input, {}, entry.ending == record::SequenceEnding::kFollowed};
    for (const auto& [file, checksum] : entry.files)
      if (run.root / file == run.plan(entry.name)) motion.checksum = checksum;
    motions.push_back(std::move(motion));
  }
  return motions;
}

std::vector<PlannedMotion> followed_plans(const record::RunFolder& run, std::ostream* told) {
  std::vector<PlannedMotion> motions = planned_motions(run);
  std::erase_if(motions, [&](const PlannedMotion& motion) {
    if (motion.followed && std::filesystem::exists(run.gains(motion.name))) return false;
    if (told)
      *told << run.plan(motion.name).string() << ": left out: "
            << (motion.followed ? "it has no feedback gains" : "it was not followed to the end") << '\n';
    return true;
  });
  return motions;
}

motion::Reference reference_of(const PlannedMotion& motion, Followed followed) {
  const files::StoredPlan stored = files::read_plan(motion.run.plan(motion.name));
  const motion::Reference reference = reference_in(motion, stored);
  return followed == Followed::kPlan ? planned_reference(reference, stored) : reference;
}

Teacher read_teacher(const PlannedMotion& motion, const rl::tracking::TrackingConfig& task,
                     Followed followed) {
  const files::StoredPlan stored = files::read_plan(motion.run.plan(motion.name));
  require_simulation(motion.run.plan(motion.name), stored.simulation, task.simulation);
  files::StoredGains feedback = files::read_gains(motion.run.gains(motion.name));
  if (feedback.gains.size() != stored.plan.residuals.size())
    throw DataError(motion.run.gains(motion.name).string(), "gains",
                    std::to_string(stored.plan.residuals.size()) + " frames, as the plan has",
                    std::to_string(feedback.gains.size()));
  Teacher teacher;
  const motion::Reference reference = reference_in(motion, stored);
  const bool own = followed == Followed::kPlan;
  teacher.clip =
      rl::tracking::make_tracking_clip(own ? planned_reference(reference, stored) : reference, task);
  teacher.motion = own ? on_own_states(reference, stored.plan) : control::trajectory_of(stored.plan);
  teacher.gains = std::move(feedback.gains);
  const float scale = feedback.curvature.trace() / static_cast<float>(kDofs);
  teacher.importance = {Eigen::MatrixXf(feedback.curvature / scale)};
  return teacher;
}

}  // namespace mimicx::teaching
