/// An untrained policy: a small network of random weights, on a short squat.
#pragma once

#include "core/random.h"
#include "motion/prepare/prepare.h"
#include "physics/lanes.h"
#include "policy_export/exported_policy.h"
#include "rl/tracking/tracking_rollout.h"
#include "synth/synthesize.h"

namespace mimicx::policy_export {

/// Its normaliser knows the states of its own roll-out; its actions are small.
inline const files::StoredPolicy& small_policy() {
  static const files::StoredPolicy policy = [] {
    synth::SynthConfig config;
    config.kind = "squat";
    files::StoredPolicy made;
    motion::Reference reference = motion::prepare_reference(synth::synthesize(config), {}, nullptr);
    reference.frames.resize(33);
    for (const physics::State<double>& x : rl::tracking::simulator_states(reference))
      made.states.push_back(physics::lane_of(physics::in_all_lanes<physics::Pack<4>>(x), 0));
    made.motion = rl::tracking::reference_of_states(reference, made.states);
    made.motion.name = "a squat";
    rl::AgentShape shape;
    shape.observation_dim = rl::tracking::kStateSize;
    shape.action_dim = kDofs;
    shape.hidden = {32, 32};
    shape.last_scale = 0.02F;
    made.agent = rl::make_agent(shape, 4);
    Random random(7, {});
    for (nn::Matrix<float>& bias : made.agent.actor.biases)
      for (Eigen::Index k = 0; k < bias.size(); ++k)
        bias.data()[k] = static_cast<float>(0.02 * random.normal());
    nn::Matrix<float> seen(0, shape.observation_dim);
    const auto act = rl::tracking::mean_action({made.agent});
    rl::tracking::roll_out(rl::tracking::make_tracking_clip(made.motion, {}), {},
                           [&](int option, const float* state, float* action) {
                             seen.conservativeResize(seen.rows() + 1, Eigen::NoChange);
                             for (Eigen::Index k = 0; k < seen.cols(); ++k)
                               seen(seen.rows() - 1, k) =
                                   state[k] + static_cast<float>(0.05 * random.normal());
                             act(option, state, action);
                           });
    const nn::Moments moments[] = {nn::moments_of(seen)};
    nn::update<float>(made.agent.observations, moments);
    return made;
  }();
  return policy;
}

inline const ExportedPolicy& exported_in_float() {
  static const ExportedPolicy exported = export_policy(small_policy(), false);
  return exported;
}
inline const ExportedPolicy& exported_in_8_bits() {
  static const ExportedPolicy exported = export_policy(small_policy(), true);
  return exported;
}

/// An untrained option with an encoder: random networks, whose scales are those of the squat's poses.
inline const nn::AutoEncoder& small_coder() {
  static const nn::AutoEncoder coder = [] {
    const auto clip = rl::tracking::make_tracking_clip(small_policy().motion, {});
    nn::Matrix<float> poses(clip->poses.count(), rl::tracking::kPoseFeatures);
    for (int t = 0; t < clip->poses.count(); ++t)
      rl::tracking::own_pose_features(clip->poses[t], poses.row(t).data());
    Random random(11, {});
    nn::AutoEncoder made{nn::make_normaliser<float>(kPoseCount, 5.0F),
                         nn::make_mlp<float>({kPoseCount, 256, 64}, 1.0F, random),
                         nn::make_mlp<float>({64, 256, kPoseCount}, 1.0F, random)};
    const nn::Moments moments[] = {nn::moments_of(poses)};
    nn::update<float>(made.inputs, moments);
    return made;
  }();
  return coder;
}
inline const ExportedPolicy& exported_option() {
  static const ExportedPolicy exported = [] {
    rl::AgentShape shape;
    shape.observation_dim = rl::tracking::kEncodedRest + small_coder().code_size();
    shape.action_dim = kDofs;
    shape.hidden = {32, 32};
    files::StoredPolicy policy = small_policy();
    policy.agent = rl::make_agent(shape, 5);
    return export_policy(policy, false, small_coder());
  }();
  return exported;
}

}  // namespace mimicx::policy_export
