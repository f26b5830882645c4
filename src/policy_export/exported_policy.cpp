#include "policy_export/exported_policy.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "core/random.h"
#include "physics/standing_state.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::policy_export {
namespace {

constexpr std::uint64_t kRecordStream = 0x7265636f7264;  // "record"
constexpr std::uint64_t kNoiseStream = 0x6e6f697365;     // "noise"
constexpr int kRecords = 4;
constexpr int kPasses = 4;                        // of the roll-outs that show what the policy sees
constexpr double kNoise = 0.05;                   // rad
constexpr int kSpacing = 1, kSpacingIn8Bits = 2;  // frames from knot to knot

/// A random state near the motion, as after a push: every number is disturbed, quaternions keep unit length.
State disturbed(State state, Random& random) {
  const auto move = [&](float& x, double by) { x += static_cast<float>(by * random.normal()); };
  for (int k = 0; k < 3; ++k) {
    move(state.p_root[k], 0.01);
    move(state.v_root[k], 0.1);
  }
  for (int body = 0; body < kBodies; ++body) {
    Vector3d turn = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      if (is_hinge(body) && k != hinge_entry(body)) continue;
      turn[k] = 0.03 * random.normal();
      move(state.omega[body][k], 0.3);
    }
    const float* q = state.q[body];
    const Quaterniond moved = (Quaterniond(q[0], q[1], q[2], q[3]) * mimicx::exp_map(turn)).normalized();
    const double values[4] = {moved.w(), moved.x(), moved.y(), moved.z()};
    for (int k = 0; k < 4; ++k) state.q[body][k] = static_cast<float>(values[k]);
  }
  return state;
}

/// Observations of the policy along the motion, once without noise and a few times with noise on its actions.
nn::Matrix<float> observations_of(const files::StoredPolicy& policy) {
  const rl::tracking::TrackingConfig task = policy.task();
  const auto clip = rl::tracking::make_tracking_clip(policy.motion, task);
  const auto act = rl::tracking::mean_action({policy.agent});
  Random random(1, {kNoiseStream});
  std::vector<float> seen;
  for (int pass = 0; pass < kPasses; ++pass)
    rl::tracking::roll_out(clip, task, [&](int option, const float* state, float* action) {
      seen.insert(seen.end(), state, state + kStateCount);
      act(option, state, action);
      for (int k = 0; k < kDofs && pass > 0; ++k) action[k] += static_cast<float>(kNoise * random.normal());
    });
  return Eigen::Map<const nn::Matrix<float>>(
      seen.data(), static_cast<Eigen::Index>(seen.size() / kStateCount), kStateCount);
}

}  // namespace

int ExportedPolicy::widest() const {
  const std::vector<int>& sizes = meant.agent.actor.sizes;
  return *std::max_element(sizes.begin(), sizes.end());
}

rl::tracking::ActionSettings exported_actions(double max_action) {
  rl::tracking::ActionSettings actions;
  actions.max_action = max_action;
  return actions;
}

ExportedPolicy export_policy(const files::StoredPolicy& policy, bool in_8_bits,
                             const std::optional<nn::AutoEncoder>& coder) {
  if (!policy.motion.scene.flat())
    throw std::invalid_argument("its motion is on a scene, and exported policies know the flat floor alone");
  if (policy.actions != exported_actions(policy.actions.max_action))
    throw std::invalid_argument("its actions have other settings than those of exported policies");
  ExportedPolicy out;
  out.meant = policy;
  out.in_8_bits = in_8_bits;
  out.coder = coder;
  rl::Agent& agent = out.meant.agent;
  if (out.widest() > kWidestEver)
    throw std::invalid_argument("its network has a layer of more than " + std::to_string(kWidestEver) +
                                " units");
  if (coder) {
    if (in_8_bits) throw std::invalid_argument("8 bits are for policies without an encoder");
    for (const nn::Mlp<float>* network : {&coder->encoder, &coder->decoder})
      if (*std::max_element(network->sizes.begin(), network->sizes.end()) > kStateCount)
        throw std::invalid_argument("its encoder has a layer of more than " + std::to_string(kStateCount) +
                                    " units");
  }
  out.max_action = static_cast<float>(policy.actions.max_action);
  out.motion = fit_spline(policy.states, policy.motion.fps, in_8_bits ? kSpacingIn8Bits : kSpacing);
  out.meant.states = states_of(out.motion);
  out.meant.motion = rl::tracking::reference_of_states(policy.motion, out.meant.states);
  if (in_8_bits) {
    fold_inputs(policy.motion.character.betas, agent);
    out.quantised = quantise(observations_of(policy), agent);
    out.inputs = out.quantised.inputs;
  } else {
    out.inputs.resize(static_cast<std::size_t>(agent.actor.inputs()));
    std::iota(out.inputs.begin(), out.inputs.end(), std::int16_t{0});
  }
  Random random(1, {kRecordStream});
  const int last = out.motion.frames - 1;
  for (int k = 0; k < kRecords; ++k) {
    const int frame = last * k / (kRecords - 1);
    out.records.push_back(answer(out, frame, disturbed(motion_at(out.motion.view(), frame), random)));
  }
  return out;
}

files::StoredPolicy standing_policy(const std::string& name, const rl::Agent& agent, const Character& body) {
  files::StoredPolicy made;
  motion::Reference standing;
  standing.name = name;
  standing.character = body;
  made.states.assign(2, physics::standing_state(body));
  made.motion = rl::tracking::reference_of_states(standing, made.states);
  made.agent = agent;
  return made;
}

std::vector<Layer<float>> float_layers(const nn::Mlp<float>& network) {
  std::vector<Layer<float>> layers;
  for (std::size_t l = 0; l < network.weights.size(); ++l)
    layers.push_back({network.sizes[l], network.sizes[l + 1], network.weights[l].data(), nullptr,
                      network.biases[l].data()});
  return layers;
}

Record answer(const ExportedPolicy& exported, int frame, const State& now) {
  Record record;
  record.frame = frame;
  record.now = now;
  with_policy(exported, [&](const auto& policy) {
    const State next = motion_at(policy.motion, frame + 1);
    observe(policy, next, now, record.observation.data());
    decide<kWidestEver>(policy, record.observation.data(), record.action.data());
    record.targets = targets_of(policy, next, record.action.data());
  });
  return record;
}

}  // namespace mimicx::policy_export
