#include "rl/gae.h"

namespace mimicx::rl {

void estimate_advantages(const AdvantageInput& in, const Discount& discount,
                         Eigen::Ref<nn::Matrix<float>> advantages) {
  const auto [gamma, lambda] = discount;
  const Eigen::Index steps = in.rewards.rows(), characters = in.rewards.cols();
  for (Eigen::Index i = 0; i < characters; ++i) {
    double next_advantage = 0.0, next_value = in.last_values(0, i);
    for (Eigen::Index t = steps - 1; t >= 0; --t) {
      if (in.terminated(t, i)) {
        next_value = 0.0;
        next_advantage = 0.0;
      } else if (in.truncated(t, i)) {
        next_value = in.final_values(t, i);
        next_advantage = 0.0;
      }
      const double value = in.values(t, i);
      const double delta = in.rewards(t, i) + gamma * next_value - value;
      next_advantage = delta + gamma * lambda * next_advantage;
      advantages(t, i) = static_cast<float>(next_advantage);
      next_value = value;
    }
  }
}

}  // namespace mimicx::rl
