// Fine-tuning: options that were trained on other motions are arranged on a new one and learn it together.
//
// You learn: what the search over real roll-outs finds; that several policies learn in one environment, each
// from its own frames; how far a tenth of the samples of 5_follow brings them.
// Belongs to: docs/method.md §8, §9 (arrangement, joint fine-tuning).
// Questions: 1. Which options act, and which never do? Why are only those kept?
//            2. Why does the value of the last frame of a stretch come from the next option's critic?
//            3. Start PPO on the same motion from nothing ("walk", 1 in 5_follow): what does it reach?
#include "motions.h"
#include "pipeline/options/arrangement.h"
#include "plot.h"
#include "program/configurations.h"
#include "rl/tracking/tracking_environment.h"
#include "rl/trainer.h"

using namespace mimicx;
using namespace mimicx::pipeline::options;

int main(int argc, char** argv) {
  program::AdaptConfig adapt = program::adapt_configuration();  // what `mimicx adapt` takes,
  adapt.arrangement.beam_width = 16;                            // with a narrower search
  const rl::tracking::TrackingConfig& config = adapt.training.tracking;
  const auto plain = rl::tracking::make_tracking_clip(tour::motion_of_kind("walk", 1), config);
  const auto set = read_options(argc > 1 ? argv[1] : MIMICX_SOURCE_DIR "/data/options");
  const ArrangedClip arranged = arrange(plain, config, *set, adapt.arrangement);
  std::printf("of %d options %d act:", set->options.count(), arranged.kept.count());
  for (const auto& [frame, option] : stretches_of(arranged.options))
    std::printf(" %d from frame %d;", option, frame);
  std::printf(" none could follow at %d frames\n", arranged.breaks.count());

  const auto rolled = [&](const std::vector<rl::Agent>& agents) {
    return roll_out(arranged.clip, config, rl::tracking::mean_action(agents));
  };
  std::printf("as they are: %s\n", tour::in_words(rolled(arranged.agents)).c_str());
  const long samples = 30000;
  rl::tracking::TrackingEnvironment world({arranged.clip}, config, 128, 32, 1);
  rl::PpoTrainer trainer(adapt.training.ppo, {.seed = 1, .falling_samples = samples}, arranged.agents, world);
  tour::Curve mean = tour::line("mean distance of the joints", 0, tour::Style::kLineAndDots);
  tour::Curve worst = tour::line("farthest body", 1, tour::Style::kLineAndDots);
  const auto show = [&](double drawn, const rl::tracking::TrackingRollout& now) {
    tour::add(mean, drawn, 1e3 * now.mean_position_error);
    tour::add(worst, drawn, 1e3 * now.worst_distance);
  };
  show(0, rolled(arranged.agents));
  while (trainer.samples() < samples) {
    const rl::IterationStats stats = trainer.iterate(1);
    if (stats.iteration % 5 != 4) continue;
    const auto now = rolled(trainer.agents());
    show(static_cast<double>(stats.samples), now);
    std::printf("%6lld samples: reward %.2f; the mean actions: %s\n", static_cast<long long>(stats.samples),
                stats.mean_reward, tour::in_words(now).c_str());
  }
  tour::save_picture("7_fine_tune", "Options learn a new walk together",
                     {{"distance from the motion",
                       "samples",
                       "mm",
                       {mean,
                        worst,
                        {"beyond this it falls", tour::Style::kDashed, 4, mean.x,
                         std::vector<double>(mean.x.size(), 500.0)}},
                       true}});
}
