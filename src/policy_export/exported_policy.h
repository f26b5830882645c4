/// A policy as `mimicx export-policy` writes it: its motion as splines, its network in 32-bit floats or in 8
/// bits (quantised_network.h), and recorded answers to test against.             docs/exported_policies.md
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "files/policy_file.h"
#include "nn/autoencoder.h"
#include "policy_export/motion_spline.h"
#include "policy_export/quantised_network.h"

namespace mimicx::policy_export {

/// A state and the answer of the policy to it, computed by runtime.h.
struct Record {
  int frame = 0;
  State now{};
  std::array<float, kStateCount> observation{};
  std::array<float, kActionCount> action{};
  Targets targets{};
};

struct ExportedPolicy {
  files::StoredPolicy meant;  ///< the same policy for the program: motion and weights of equal bits
  float max_action = 0.0F;    ///< rad
  MotionSpline motion;
  bool in_8_bits = false;
  QuantisedNetwork quantised;        ///< used if `in_8_bits`
  std::vector<std::int16_t> inputs;  ///< inputs of the first layer as indices into the observation
  std::vector<Record> records;
  std::optional<nn::AutoEncoder> coder;  ///< through which an option sees its target; in float alone

  int widest() const;  ///< largest number of inputs or outputs of a layer of the policy's network
};

inline constexpr int kWidestEver = 4096;  ///< largest width of an exported network

/// The only settings of actions that runtime.h has; it takes any bound.
rl::tracking::ActionSettings exported_actions(double max_action);

/// @param coder  of an option that has one
/// @throws std::invalid_argument for networks that runtime.h cannot run, and as fit_spline
ExportedPolicy export_policy(const files::StoredPolicy& policy, bool in_8_bits,
                             const std::optional<nn::AutoEncoder>& coder = std::nullopt);

/// An option that stands until it gets targets from outside: the policy of two frames of standing.
/// @param body  whose joints and shape it is made for
files::StoredPolicy standing_policy(const std::string& name, const rl::Agent& agent, const Character& body);

/// Calls f with the policy in runtime.h's form: a Policy<float>, a Policy<std::int8_t> in 8 bits, or a
/// CodedPolicy<float>. Its pointers are valid during the call only.
template <class F>
void with_policy(const ExportedPolicy& exported, F&& f);

/// The layers of a network in runtime.h's form, which refer to it.
std::vector<Layer<float>> float_layers(const nn::Mlp<float>& network);

/// The policy's answer, computed in the runtime's arithmetic.
Record answer(const ExportedPolicy& exported, int frame, const State& now);

// ---- the template -------------------------------------------------------------------------------

template <class F>
void with_policy(const ExportedPolicy& exported, F&& f) {
  const rl::Agent& agent = exported.meant.agent;
  const auto& actor = agent.actor;
  const Character& character = exported.meant.motion.character;
  std::vector<double> offsets;
  for (const Vector3d& offset : character.joint_offset)
    offsets.insert(offsets.end(), offset.begin(), offset.end());
  std::vector<float> shape, mean, factor;
  for (const double beta : character.betas) shape.push_back(static_cast<float>(beta));
  for (const std::int16_t i : exported.inputs) {
    mean.push_back(agent.observations.shift(0, i));
    factor.push_back(agent.observations.factor(0, i));
  }
  const auto policy_with = [&]<class Weight>(const std::vector<Layer<Weight>>& layers,
                                             const std::int8_t* powers) {
    return Policy<Weight>{exported.motion.view(),
                          offsets.data(),
                          shape.data(),
                          exported.inputs.data(),
                          mean.data(),
                          factor.data(),
                          agent.observations.limit,
                          powers,
                          static_cast<int>(layers.size()),
                          layers.data(),
                          exported.max_action};
  };
  if (exported.in_8_bits) {
    std::vector<Layer<std::int8_t>> layers;
    for (std::size_t l = 0; l < actor.weights.size(); ++l)
      layers.push_back({l == 0 ? static_cast<int>(exported.inputs.size()) : actor.sizes[l],
                        actor.sizes[l + 1], exported.quantised.layers[l].codes.data(),
                        exported.quantised.layers[l].scales.data(), actor.biases[l].data()});
    f(policy_with(layers, exported.quantised.powers.data()));
    return;
  }
  const std::vector<Layer<float>> layers = float_layers(actor);
  const Policy<float> policy = policy_with(layers, nullptr);
  if (!exported.coder) return f(policy);
  const nn::AutoEncoder& coder = *exported.coder;
  const std::vector<Layer<float>> encoder = float_layers(coder.encoder),
                                  decoder = float_layers(coder.decoder);
  f(CodedPolicy<float>{policy, coder.inputs.shift.data(), coder.inputs.factor.data(), coder.inputs.limit,
                       static_cast<int>(encoder.size()), static_cast<int>(decoder.size()), encoder.data(),
                       decoder.data()});
}

}  // namespace mimicx::policy_export
