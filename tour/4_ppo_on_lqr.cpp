// PPO on a task whose best policy is known: a mass on a line that is pushed to its place.
//
// You learn: what an environment is (reset, observe, step); the loop of PPO; that its curve settles around
// the gain of the Riccati equation, and what moves it there.
// Belongs to: docs/method.md §7; docs/control.md §1; docs/equations.md: GAE (Schulman 2016), the clipped
// surrogate (Schulman 2017).
// Questions: 1. Which discount does the Riccati equation use here? Change gamma: does the policy follow?
//            2. What happens without exploration (sigma 0.01), and with far too much (sigma 3)?
//            3. The cost of a push falls to a tenth. Predict the new gains, then run.
#include <array>

#include <Eigen/Dense>

#include "plot.h"
#include "rl/task_environment.h"
#include "rl/trainer.h"

using namespace mimicx;

// x' = A x + B u, reward −(xᵀQx + R u²).
struct Mass {
  static constexpr int kState = 2, kObservation = 2, kAction = 1, kLimit = 50;
  static constexpr double kDt = 0.2, kPlace = 1.0, kSpeed = 0.1, kPush = 0.1;
  using State = std::array<double, kState>;

  static State reset(Random& random) {
    const double place = random.uniform(-1.0, 1.0);
    return {place, random.uniform(-1.0, 1.0)};
  }
  static void observe(const State& s, float* out) {
    for (int k = 0; k < 2; ++k) out[k] = static_cast<float>(s[static_cast<std::size_t>(k)]);
  }
  static rl::TaskOutcome step(State& s, const float* action, Random&) {
    const double u = action[0];
    const double cost = kPlace * s[0] * s[0] + kSpeed * s[1] * s[1] + kPush * u * u;
    s = {s[0] + kDt * s[1], s[1] + kDt * u};
    return {-cost};
  }
};

// K of u = −K x that is best for Σ γᵗ cost: the discounted Riccati equation, iterated.
Eigen::RowVector2d riccati_gain(double gamma) {
  Eigen::Matrix2d A, Q = Eigen::Vector2d(Mass::kPlace, Mass::kSpeed).asDiagonal(), P = Q;
  A << 1.0, Mass::kDt, 0.0, 1.0;
  const Eigen::Vector2d B(0.0, Mass::kDt);
  Eigen::RowVector2d K;
  for (int k = 0; k < 2000; ++k) {
    K = gamma * (B.transpose() * P * A) / (Mass::kPush + gamma * B.dot(P * B));
    P = Q + gamma * A.transpose() * P * (A - B * K);
  }
  return K;
}

// K of the policy: a linear network behind the normaliser of its observations.
Eigen::RowVector2d learnt_gain(const rl::Agent& agent) {
  const auto& weights = agent.actor.weights[0];
  const auto& factor = agent.observations.factor;
  return -Eigen::RowVector2d(weights(0, 0) * factor(0, 0), weights(1, 0) * factor(0, 1));
}

int main() {
  rl::TaskEnvironment<Mass> world(4, 64, 1);  // 4 groups of 64 characters
  rl::PpoConfig config;
  config.horizon = 32;
  config.gamma = 0.97;
  config.lambda = 0.95;
  config.sigma_start = config.sigma_end = 0.4;
  config.kl_target = 0.02;
  config.minibatch = 4096;
  config.step_max = 1e-2;
  rl::Agent agent = rl::make_agent({.observation_dim = 2, .action_dim = 1, .hidden = {16, 16}}, 1);
  Random random(1);
  agent.actor = nn::make_mlp<float>({2, 1}, 0.02F, random);  // a linear policy beside a deep critic
  rl::PpoTrainer trainer(config, {.seed = 1, .falling_samples = 1}, {agent}, world);

  const Eigen::RowVector2d best = riccati_gain(config.gamma);
  Eigen::RowVector2d mean = Eigen::RowVector2d::Zero();
  tour::Curve place = tour::line("on the place", 0), speed = tour::line("on the speed", 1);
  for (int k = 0; k <= 400; ++k) {
    const rl::IterationStats stats = trainer.iterate(1);
    const Eigen::RowVector2d gain = learnt_gain(trainer.learner().agent);
    tour::add(place, static_cast<double>(stats.samples), gain[0]);
    tour::add(speed, static_cast<double>(stats.samples), gain[1]);
    if (k > 300) mean += gain / 100;
    if (k % 100 == 0)
      std::printf("%7lld samples: reward %+.2f, gains %.2f %.2f\n", static_cast<long long>(stats.samples),
                  stats.mean_reward, gain[0], gain[1]);
  }
  std::printf("mean of the last 100 iterations: gains %.2f %.2f\n", mean[0], mean[1]);
  std::printf("Riccati equation:                gains %.2f %.2f\n", best[0], best[1]);
  const std::vector<double> ends = {place.x.front(), place.x.back()};
  tour::save_picture("4_ppo_on_lqr", "The gains of PPO approach those of the Riccati equation",
                     {{"gains",
                       "samples",
                       "",
                       {place,
                        speed,
                        {"best", tour::Style::kDashed, 4, ends, {best[0], best[0]}},
                        {"", tour::Style::kDashed, 4, ends, {best[1], best[1]}}}}});
}
