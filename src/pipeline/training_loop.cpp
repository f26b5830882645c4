#include "pipeline/training_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/file.h"
#include "core/npz/npz.h"
#include "core/number_text.h"
#include "core/parallel.h"
#include "motion/metrics.h"
#include "pipeline/training_log.h"
#include "rl/tracking/tracking_environment.h"
#include "rl/tracking/tracking_rollout.h"
#include "rl/trainer.h"

namespace mimicx::pipeline {
namespace {

using Trainer = rl::PpoTrainer<rl::tracking::TrackingEnvironment>;

constexpr const char* kChecksumKey = "input_checksum";
constexpr const char* kTrainerPrefix = "trainer.";
constexpr const char* kBestPrefix = "best.";
constexpr const char* kBestScoreKey = "best_score";
constexpr const char* kBestAgeKey = "best_age";
constexpr const char* kEndingKey = "ending";
constexpr const char* kBegunKey = "begun_samples";
constexpr double kBetter = 0.99;   ///< a score below this share of the best one resets the stall count
constexpr double kFarthest = 3.0;  ///< m; no roll-out scores more
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

using Clips = List<std::shared_ptr<const rl::tracking::TrackingClip>>;

/// The agents whose mean actions followed the clips best so far. The roll-out decides, not the last
/// iteration: rewards under exploration noise do not show how good a mean action is, and late updates may
/// unlearn a hard part.
struct Best {
  std::vector<rl::Agent> agents;
  double score = std::numeric_limits<double>::infinity();
  int age = 0;  ///< roll-outs since the last marked improvement
};

/// What a checkpoint holds beside the trainer.
struct TrainingState {
  Best best;
  record::Table log;
  record::SequenceEnding ending = record::SequenceEnding::kNone;  ///< kNone: it goes on
  std::int64_t begun_samples = 0;                                 ///< budget that the training began with
};

/// Roll-outs of the mean actions over all clips.
struct MeanRollout {
  double score = 0.0;           ///< m, mean over clips; smaller is better
  double reward = 0.0;          ///< mean over clips
  double position_error = 0.0;  ///< m, mean over clips
  bool stayed = true;           ///< with every clip
};

MeanRollout evaluate(const Clips& clips, const rl::tracking::TrackingConfig& config,
                     const std::vector<rl::Agent>& agents, int threads) {
  List<MeanRollout> each(clips.size());
  parallel_for(clips.count(), threads, [&](int k) {
    const rl::tracking::TrackingRollout rollout =
        rl::tracking::roll_out(clips[k], config, rl::tracking::mean_action(agents));
    each[k] = {std::min(kFarthest, rl::tracking::distance_from_clip(rollout)), rollout.mean_reward,
               rollout.mean_position_error, rl::tracking::stays_with_clip(rollout)};
  });
  MeanRollout mean;
  for (const MeanRollout& e : each) {
    mean.score += e.score / static_cast<double>(clips.size());
    mean.reward += e.reward / static_cast<double>(clips.size());
    mean.position_error += e.position_error / static_cast<double>(clips.size());
    mean.stayed = mean.stayed && e.stayed;
  }
  return mean;
}

/// Keeps the agents if they are the best so far, and counts roll-outs without marked improvement.
void consider(Best& best, const Trainer& trainer, double score) {
  best.age = stall_age(best.age, score, best.score);
  if (score < best.score) {
    best.score = score;
    best.agents = trainer.agents();
  }
}

void write_falls(const std::filesystem::path& path, const std::vector<double>& rates, int bin_frames) {
  record::Table table{{"frame", "fall_rate"}, {}};
  for (std::size_t b = 0; b < rates.size(); ++b)
    table.rows.push_back({static_cast<double>(static_cast<int>(b) * bin_frames), rates[b]});
  write_file_atomically(path, record::format_csv(table));
}

/// Writes the log first, so that it always has all rows of the checkpoint.
void save(const Trainer& trainer, const rl::tracking::TrackingEnvironment& environment,
          const TrainingConfig& config, const TrainingFiles& files, const TrainingState& state) {
  const Best& best = state.best;
  for (const auto* file : {&files.log, &files.falls, &files.checkpoint}) make_folder(file->parent_path());
  write_file_atomically(files.log, record::format_csv(state.log));
  if (environment.fall_rates().size() == 1)
    write_falls(files.falls, environment.fall_rates().front(), config.tracking.bin_frames);
  Npz archive;
  archive.set(kChecksumKey, NpyArray::scalar_text(files.input_checksum));
  trainer.save(archive, kTrainerPrefix);
  for (std::size_t k = 0; k < best.agents.size(); ++k)
    rl::save(archive, kBestPrefix + std::to_string(k) + ".", best.agents[k]);
  archive.set(kBestScoreKey, NpyArray::scalar(best.score));
  archive.set(kBestAgeKey, NpyArray::scalar_int(best.age));
  archive.set(kEndingKey, NpyArray::scalar_int(static_cast<int>(state.ending)));
  archive.set(kBegunKey, NpyArray::scalar_int(state.begun_samples));
  write_npz(files.checkpoint, archive);
}

/// Continues from the checkpoint, if there is one of this input, and drops newer rows of the log.
void resume(Trainer& trainer, const TrainingFiles& files, TrainingState& state) {
  if (!std::filesystem::exists(files.checkpoint)) return;
  const Npz archive = read_npz(files.checkpoint);
  if (archive.at(kChecksumKey).text != std::vector<std::string>{files.input_checksum}) return;
  Best& best = state.best;
  trainer.load(archive, kTrainerPrefix);
  for (std::size_t k = 0; k < best.agents.size(); ++k)
    best.agents[k] = rl::load_agent(archive, kBestPrefix + std::to_string(k) + ".");
  best.score = number_at(archive, kBestScoreKey);
  best.age = static_cast<int>(whole_number_at(archive, kBestAgeKey));
  state.log.rows = record::read_csv(files.log).rows;
  const auto iterations = static_cast<std::size_t>(trainer.iterations());
  if (state.log.rows.size() > iterations) state.log.rows.resize(iterations);
  state.ending = static_cast<record::SequenceEnding>(static_cast<int>(whole_number_at(archive, kEndingKey)));
  if (archive.has(kBegunKey)) state.begun_samples = whole_number_at(archive, kBegunKey);
}

std::string detail_of(const rl::IterationStats& s) {
  return formatted("reward %.3f, episodes of %.0f steps", s.mean_reward, s.mean_episode_length);
}

}  // namespace

std::function<void(std::int64_t, const std::string&)> progress_of_training(record::Progress& progress,
                                                                           const std::string& label,
                                                                           std::int64_t samples) {
  return [&progress, label, samples, started = false](std::int64_t done, const std::string& detail) mutable {
    if (!started) progress.start(label, static_cast<double>(done), static_cast<double>(samples));
    started = true;
    progress.update(static_cast<double>(done), detail);
  };
}

int stall_age(int age, double score, double best_score) {
  const bool followed = score < motion::kMaxBodyDistance;
  return !followed || score < kBetter * best_score ? 0 : age + 1;
}

rl::Course course_of(const TrainingConfig& config) {
  return {config.seed, static_cast<std::int64_t>(config.sigma_share * static_cast<double>(config.samples))};
}

rl::Agent untrained_agent(const TrainingConfig& config, int state_size) {
  return rl::make_agent({state_size, kDofs, config.hidden}, config.seed);
}

TrainingResult train(const std::vector<std::shared_ptr<const rl::tracking::TrackingClip>>& clips,
                     std::vector<rl::Agent> agents, const TrainingConfig& config, const TrainingFiles& files,
                     const TrainingControl& control) {
  rl::tracking::TrackingEnvironment environment(clips, config.tracking, config.characters, config.group_size,
                                                config.seed);
  TrainingState state{{agents}, empty_training_log(), record::SequenceEnding::kNone, config.samples};
  Trainer trainer(config.ppo, course_of(config), std::move(agents), environment);
  resume(trainer, files, state);
  Best& best = state.best;
  record::SequenceEnding& ending = state.ending;
  control.progress(trainer.samples(), "");

  const double started = record::steady_seconds();
  double saved = started;
  TrainingResult result;
  if (std::isinf(best.score))  // the initial agents are candidates, too
    consider(best, trainer, evaluate(clips, config.tracking, best.agents, control.threads).score);
  if (config.samples == 0) ending = record::SequenceEnding::kBudget;
  if (ending == record::SequenceEnding::kBudget && trainer.samples() < config.samples)
    ending = record::SequenceEnding::kNone;  // this budget is larger than the checkpoint's
  // A checkpoint of more samples belongs to a later, larger budget (pretrain.h): nothing to train here.
  while (ending == record::SequenceEnding::kNone && trainer.samples() < config.samples) {
    const double sharpness = environment.sharpness();  // of the rewards of this iteration
    const rl::IterationStats stats = trainer.iterate(control.threads);
    if (stats.samples >= config.samples) ending = record::SequenceEnding::kBudget;
    TrainingLogRow row = {stats, environment.statistics(), sharpness, kNan, kNan};
    if (ending == record::SequenceEnding::kBudget || stats.iteration % config.evaluate_iterations == 0) {
      const MeanRollout rollout = evaluate(clips, config.tracking, trainer.agents(), control.threads);
      consider(best, trainer, rollout.score);
      row.rollout_reward = rollout.reward;
      row.rollout_position_error = rollout.position_error;
      if (config.stop_reward > 0.0 && rollout.stayed && rollout.reward >= config.stop_reward)
        ending = record::SequenceEnding::kThreshold;
      else if (config.stall_evaluations > 0 && best.age >= config.stall_evaluations)
        ending = record::SequenceEnding::kStall;
    }
    append(state.log, row);
    control.progress(stats.samples, detail_of(stats));
    if (ending != record::SequenceEnding::kNone) break;
    const double now = record::steady_seconds();
    if (now - saved >= control.checkpoint_seconds) {
      save(trainer, environment, config, files, state);
      saved = now;
    }
    if (control.should_stop()) {
      result.interrupted = true;
      break;
    }
    if (control.limit_seconds > 0.0 && now - started >= control.limit_seconds) {
      result.ending = record::SequenceEnding::kLimitSeconds;
      break;
    }
  }
  save(trainer, environment, config, files, state);
  if (ending != record::SequenceEnding::kNone) result.ending = ending;
  result.agents = best.agents;
  result.samples = trainer.samples();
  result.begun_samples = state.begun_samples;
  result.seconds = record::steady_seconds() - started;
  return result;
}

}  // namespace mimicx::pipeline
