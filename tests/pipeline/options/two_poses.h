/// A clip with a pose for each half, and an option for each pose.
#pragma once

#include <algorithm>

#include "pipeline/options/constant_option.h"
#include "pipeline/options/option_set.h"

namespace mimicx::pipeline::options {

/// Stands with bent knees; the arms hang in the first half and are held out in the second.
inline motion::Reference two_poses(int frames) {
  constexpr int kRaising = 8;  // frames that this takes
  motion::Reference reference = rl::tracking::swaying_reference(frames);
  for (std::size_t t = 0; t < reference.frames.size(); ++t) {
    const double raised = std::clamp((static_cast<double>(t) - 0.5 * frames) / kRaising + 0.5, 0.0, 1.0);
    const double down = 1.2 - 0.9 * raised;
    reference.frames[t].q[kLeftShoulder] = exp_map(Vector3d(0, 0, -down));
    reference.frames[t].q[kRightShoulder] = exp_map(Vector3d(0, 0, down));
  }
  motion::differentiate(reference.frames, reference.fps);
  for (std::size_t t = 0; t < reference.frames.size(); ++t) {
    const motion::ReferenceFrame& f = reference.frames[t];
    reference.poses[t] = forward_kinematics(reference.character, f.p_root, f.q);
  }
  return reference;
}

/// Actions are poses, not corrections of the reference, so an option may be right in one half and wrong in
/// the other. A body that only holds a pose leans in time; here that is no fall.
inline rl::tracking::TrackingConfig absolute_actions() {
  rl::tracking::TrackingConfig config;
  config.actions.mode = rl::tracking::ActionMode::kAbsolute;
  config.terminate_distance = 2.0;
  return config;
}

/// An option that always aims at the pose of this frame.
inline Option option_that_aims_at(const motion::ReferenceFrame& frame) {
  Option option = constant_option(rl::tracking::kStateSize, 0.0F);
  auto& target = option.agent.actor.biases.back();
  for (int body = 1; body < kBodies; ++body) {
    const Vector3d rotation = log_map(frame.q[body]);
    const int dof = first_dof(body);
    if (is_hinge(body))
      target(dof) = static_cast<float>(rotation.dot(hinge_axis(body)));
    else
      for (int k = 0; k < 3; ++k) target(dof + k) = static_cast<float>(rotation[k]);
  }
  return option;
}

/// That of the second half first, then that of the first half.
inline OptionSet options_of_halves(const motion::Reference& reference) {
  OptionSet set;
  for (const auto& frame : {reference.frames.back(), reference.frames.front()}) {
    TrainedOption trained;
    trained.option = option_that_aims_at(frame);
    set.options.push_back(trained);
  }
  return set;
}

}  // namespace mimicx::pipeline::options
