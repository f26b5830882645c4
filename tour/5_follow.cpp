// A policy learns to follow one motion, from nothing.
//
// You learn: what a policy sees (570 numbers) and does (55 angles); the reward of Eq. 2; why episodes start
// anywhere on the motion; what a curve of PPO looks like on a body.
// Belongs to: docs/method.md §3, §4, §5, §7 (states, actions, reward, learning); Eqs. 2, 3.
// Questions: 1. How does the body do before the first iteration, and why is that not nothing at all?
//            2. Set uniform_starts, a share of 0.4, to 1, here and on a walk ("walk", 2). Where does the
//            curve
//               lose by it, and why there?
//            3. Make actions absolute (ActionMode::kAbsolute). What must the policy learn in addition, and
//            how
//               far do these samples bring it?
#include <cstdlib>

#include "motions.h"
#include "plot.h"
#include "rl/tracking/tracking_environment.h"
#include "rl/trainer.h"

using namespace mimicx;

int main(int argc, char** argv) {
  const long samples = argc > 1 ? std::atol(argv[1]) : 300000;  // 5_follow 2000000 takes some minutes
  const motion::Reference reference = tour::motion_of_kind("squat", 1);
  rl::tracking::TrackingConfig config;  // to change it: config.uniform_starts = 1.0;
  const auto clip = rl::tracking::make_tracking_clip(reference, config);
  std::printf("the motion: %s, %d frames; s_t has %d numbers, a_t %d\n", reference.name.c_str(),
              reference.size(), clip->state_size(), kDofs);

  rl::tracking::TrackingEnvironment world({clip}, config, 256, 64, 1);
  rl::PpoConfig ppo;  // the defaults train one motion from scratch
  const rl::Agent untrained =
      rl::make_agent({.observation_dim = clip->state_size(), .action_dim = kDofs, .hidden = {128, 128}}, 1);
  rl::PpoTrainer trainer(ppo, {.seed = 1, .falling_samples = samples * 3 / 4}, {untrained}, world);
  const auto rolled = [&](const rl::Agent& agent) {
    return roll_out(clip, config, rl::tracking::mean_action({agent}));
  };
  std::printf("untrained: %s\n", tour::in_words(rolled(untrained)).c_str());

  tour::Curve reward = tour::line("of the learner", 0);
  tour::Curve mean = tour::line("of the mean action", 1, tour::Style::kLineAndDots);
  tour::Curve error = tour::line("", 1, tour::Style::kLineAndDots);
  while (trainer.samples() < samples) {
    const rl::IterationStats stats = trainer.iterate(1);
    const double drawn = static_cast<double>(stats.samples);
    tour::add(reward, drawn, stats.mean_reward);
    if (stats.iteration % 15 != 14) continue;
    const auto now = rolled(trainer.learner().agent);
    tour::add(mean, drawn, now.mean_reward);
    tour::add(error, drawn, 1e3 * now.mean_position_error);
    std::printf("%7.0f samples: reward %.2f; the mean action: %s\n", drawn, stats.mean_reward,
                tour::in_words(now).c_str());
  }
  Npz policy;  // for 8_plan
  rl::save(policy, "agent.", trainer.learner().agent);
  make_folder("out/tour");
  write_npz("out/tour/5_follow.npz", policy);
  tour::save_picture("5_follow", "PPO learns to follow a squat",
                     {{"reward", "samples", "mean reward of a frame", {reward, mean}, false, true},
                      {"error", "samples", "mean distance of the joints, mm", {error}, false, true}});
}
