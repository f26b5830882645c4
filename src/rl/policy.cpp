#include "rl/policy.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "nn/checkpoint.h"

namespace mimicx::rl {

namespace {

std::vector<int> layer_sizes(int inputs, const std::vector<int>& hidden, int outputs) {
  std::vector<int> sizes = {inputs};
  sizes.insert(sizes.end(), hidden.begin(), hidden.end());
  sizes.push_back(outputs);
  return sizes;
}

}  // namespace

double ReturnScale::deviation() const {
  const double variance = std::max(square - mean * mean, 0.01 * square);
  return variance > 0.0 ? std::sqrt(variance) : 1.0;
}

Agent make_agent(const AgentShape& shape, std::uint64_t seed) {
  Random actor_random(seed, {kActorInit}), critic_random(seed, {kCriticInit});
  return {nn::make_mlp(layer_sizes(shape.observation_dim, shape.hidden, shape.action_dim), shape.last_scale,
                       actor_random),
          nn::make_mlp(layer_sizes(shape.observation_dim, shape.hidden, 1), 1.0F, critic_random),
          nn::make_normaliser<float>(shape.observation_dim, shape.observation_limit),
          {}};
}

void sample_actions(const nn::Matrix<float>& means, double sigma, Random& random, nn::Matrix<float>& actions,
                    Eigen::Ref<Eigen::VectorXf> log_density) {
  actions.resize(means.rows(), means.cols());
  for (Eigen::Index row = 0; row < means.rows(); ++row) {
    double squares = 0.0;
    for (Eigen::Index k = 0; k < means.cols(); ++k) {
      const double noise = random.normal();
      squares += noise * noise;
      actions(row, k) = means(row, k) + static_cast<float>(sigma * noise);
    }
    log_density[row] = static_cast<float>(-0.5 * squares);
  }
}

void unscale_values(const ReturnScale& scale, nn::Matrix<float>& values) {
  values = (values.array() * static_cast<float>(scale.deviation()) + static_cast<float>(scale.mean)).matrix();
}

void follow_returns(ReturnScale& scale, double mean, double square, double rate) {
  const double blend = scale.batches == 0 ? 1.0 : rate;
  scale.mean += blend * (mean - scale.mean);
  scale.square += blend * (square - scale.square);
  ++scale.batches;
}

void save(Npz& archive, const std::string& prefix, const Agent& agent) {
  nn::save(archive, prefix + "actor.", agent.actor);
  nn::save(archive, prefix + "critic.", agent.critic);
  nn::save(archive, prefix + "observations.", agent.observations);
  const double scale[] = {agent.returns.mean, agent.returns.square};
  archive.set(prefix + "returns.scale", NpyArray::from_double({2}, scale));
  archive.set(prefix + "returns.batches", NpyArray::scalar_int(agent.returns.batches));
}

Agent load_agent(const Npz& archive, const std::string& prefix) {
  Agent agent{nn::load_mlp<float>(archive, prefix + "actor."),
              nn::load_mlp<float>(archive, prefix + "critic."),
              nn::load_normaliser<float>(archive, prefix + "observations."),
              {}};
  for (const nn::Mlp<float>* network : {&agent.actor, &agent.critic})
    if (network->inputs() != agent.observations.features())
      throw DataError(archive.path, prefix + "observations.mean",
                      std::to_string(network->inputs()) + " numbers",
                      std::to_string(agent.observations.features()));
  const std::vector<double> scale = numbers_at(archive, prefix + "returns.scale", 2);
  agent.returns = {scale[0], scale[1], whole_number_at(archive, prefix + "returns.batches")};
  return agent;
}

}  // namespace mimicx::rl
