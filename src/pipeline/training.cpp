#include "pipeline/training.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "core/npz.h"
#include "pipeline/progress.h"
#include "rl/tracking_environment.h"
#include "rl/tracking_rollout.h"
#include "rl/trainer.h"

namespace mimicx {
namespace {

using Trainer = rl::PpoTrainer<rl::TrackingEnvironment>;

constexpr const char* kChecksumKey = "input_checksum";
constexpr const char* kTrainerPrefix = "trainer.";
constexpr const char* kBestPrefix = "best.";
constexpr const char* kBestScoreKey = "best_score";
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The agent whose mean action followed the whole clip best so far. Exploration noise hides how good a mean
/// action is, and late updates may unlearn a hard moment: the roll-out decides, not the last iteration.
struct Best {
  rl::Agent agent;
  double score = std::numeric_limits<double>::infinity();
};

/// Mean position error, m; a body that strayed beyond the limit of success (docs/metrics.md) outweighs it.
double score_of(const rl::TrackingRollout& rollout) {
  constexpr double kLost = 0.5;
  if (rollout.broken) return 1e3;
  return rollout.mean_position_error + (rollout.worst_distance > kLost ? rollout.worst_distance : 0.0);
}

Table empty_log() {
  Table log;
  log.columns = {"iteration", "samples", "reward", "episode_length"};
  for (const auto name : rl::kRewardTermNames) log.columns.push_back("reward_term:" + std::string(name));
  const auto rest = {"kl",
                     "step_size",
                     "sigma",
                     "policy_loss",
                     "value_loss",
                     "explained_variance",
                     "clip_fraction",
                     "gradient_norm:actor",
                     "gradient_norm:critic",
                     "penalty",
                     "saturation:actions",
                     "saturation:torques",
                     "sharpness",
                     "rollout_reward",
                     "rollout_position_error_mm"};
  log.columns.insert(log.columns.end(), rest.begin(), rest.end());
  return log;
}

/// @param rollout  of the mean action after this iteration, or null
std::vector<double> log_row(const rl::IterationStats& s, const rl::TrackingStatistics& tracking,
                            double sharpness, const rl::TrackingRollout* rollout) {
  const auto steps = static_cast<double>(std::max<std::int64_t>(tracking.steps, 1));
  std::vector<double> row = {static_cast<double>(s.iteration), static_cast<double>(s.samples), s.mean_reward,
                             s.mean_episode_length};
  for (double term : tracking.reward_terms) row.push_back(term / steps);
  row.insert(row.end(), {s.kl, s.step_size, s.sigma, s.policy_loss, s.value_loss, s.explained_variance,
                         s.clip_fraction, s.actor_gradient, s.critic_gradient, s.penalty, s.saturation,
                         tracking.saturated_joints / (steps * kJoints), sharpness,
                         rollout != nullptr ? rollout->mean_reward : kNan,
                         rollout != nullptr ? 1e3 * rollout->mean_position_error : kNan});
  return row;
}

void write_falls(const std::filesystem::path& path, const std::vector<double>& rates, int bin_frames) {
  Table table{{"frame", "fall_rate"}, {}};
  for (std::size_t b = 0; b < rates.size(); ++b)
    table.rows.push_back({static_cast<double>(static_cast<int>(b) * bin_frames), rates[b]});
  write_file_atomically(path, format_csv(table));
}

/// The log first: a checkpoint never stands beside a log that lacks its rows.
void save(const Trainer& trainer, const rl::TrackingEnvironment& environment, const TrainingConfig& config,
          const TrainingFiles& files, const Best& best, const Table& log) {
  write_file_atomically(files.log, format_csv(log));
  write_falls(files.falls, environment.fall_rates().front(), config.tracking.bin_frames);
  Npz archive;
  archive.set(kChecksumKey, NpyArray::scalar_text(files.input_checksum));
  trainer.save(archive, kTrainerPrefix);
  rl::save(archive, kBestPrefix, best.agent);
  archive.set(kBestScoreKey, NpyArray::scalar(best.score));
  write_npz(files.checkpoint, archive);
}

/// Takes up the checkpoint, if there is one of this input, and drops the log's rows after it.
void resume(Trainer& trainer, const TrainingFiles& files, Best& best, Table& log) {
  if (!std::filesystem::exists(files.checkpoint)) return;
  const Npz archive = read_npz(files.checkpoint);
  if (archive.at(kChecksumKey).text != std::vector<std::string>{files.input_checksum}) return;
  trainer.load(archive, kTrainerPrefix);
  best.agent = rl::load_agent(archive, kBestPrefix);
  best.score = archive.at(kBestScoreKey).to_double().at(0);
  log.rows = read_csv(files.log).rows;
  const auto iterations = static_cast<std::size_t>(trainer.learner().iteration);
  if (log.rows.size() > iterations) log.rows.resize(iterations);
}

rl::PpoConfig seeded(const TrainingConfig& config) {
  rl::PpoConfig ppo = config.ppo;
  ppo.seed = config.seed;
  ppo.sigma_samples = static_cast<std::int64_t>(config.sigma_share * static_cast<double>(config.samples));
  return ppo;
}

std::string detail_of(const rl::IterationStats& s) {
  char text[64];
  std::snprintf(text, sizeof text, "reward %.3f, episodes of %.0f steps", s.mean_reward,
                s.mean_episode_length);
  return text;
}

}  // namespace

rl::Agent untrained_agent(const TrainingConfig& config) {
  rl::AgentShape shape;
  shape.observation_dim = rl::kStateSize;
  shape.action_dim = kDofs;
  shape.hidden = config.hidden;
  return rl::make_agent(shape, config.seed);
}

TrainingResult train(const std::shared_ptr<const rl::TrackingClip>& clip, const TrainingConfig& config,
                     const TrainingFiles& files, const TrainingControl& control) {
  rl::TrackingEnvironment environment({clip}, config.tracking, config.characters, config.group_size,
                                      config.seed);
  Trainer trainer(seeded(config), untrained_agent(config), environment);
  Table log = empty_log();
  Best best{trainer.learner().agent};
  resume(trainer, files, best, log);
  control.progress(trainer.learner().samples, "");

  const double started = steady_seconds();
  double saved = started;
  TrainingResult result;
  while (trainer.learner().samples < config.samples) {
    const rl::IterationStats stats = trainer.iterate(control.threads);
    const bool last = stats.samples >= config.samples;
    if (last || stats.iteration % config.evaluate_iterations == 0) {
      const rl::TrackingRollout rollout =
          rl::roll_out(clip, config.tracking, rl::mean_action(trainer.learner().agent));
      if (score_of(rollout) < best.score) best = {trainer.learner().agent, score_of(rollout)};
      log.rows.push_back(log_row(stats, environment.statistics(), environment.sharpness(), &rollout));
    } else {
      log.rows.push_back(log_row(stats, environment.statistics(), environment.sharpness(), nullptr));
    }
    control.progress(stats.samples, detail_of(stats));
    const double now = steady_seconds();
    if (now - saved >= control.checkpoint_seconds) {
      save(trainer, environment, config, files, best, log);
      saved = now;
    }
    if (last) break;
    if (control.should_stop()) {
      result.interrupted = true;
      break;
    }
    if (control.limit_seconds > 0.0 && now - started >= control.limit_seconds) {
      result.ending = Ending::kLimitSeconds;
      break;
    }
  }
  save(trainer, environment, config, files, best, log);
  result.agent = best.agent;
  result.samples = trainer.learner().samples;
  result.seconds = steady_seconds() - started;
  return result;
}

}  // namespace mimicx
