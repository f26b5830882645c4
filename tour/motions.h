/// Synthetic motions for the programs of the tour, as references and as clips of the tracking task.
#pragma once

#include <memory>
#include <string>

#include "motion/prepare/prepare.h"
#include "rl/tracking/tracking_clip.h"
#include "rl/tracking/tracking_rollout.h"
#include "synth/synthesize.h"

namespace mimicx::tour {

/// The first `seconds` of a synthetic motion (docs/method.md, "Synthetic motions"), prepared.
inline motion::Reference motion_of_kind(const std::string& kind, std::uint64_t seed, int seconds = 4) {
  synth::SynthConfig config;
  config.kind = kind;
  config.seed = seed;
  config.seconds = seconds;
  return motion::prepare_reference(synth::synthesize(config), {}, nullptr);
}

/// "18 mm from the motion, farthest body 95 mm", or that it fell.
inline std::string in_words(const rl::tracking::TrackingRollout& rolled) {
  char text[80];
  if (rolled.broken || rolled.worst_distance > 0.5) return "falls";
  std::snprintf(text, sizeof text, "%.0f mm from the motion, farthest body %.0f mm",
                1e3 * rolled.mean_position_error, 1e3 * rolled.worst_distance);
  return text;
}

}  // namespace mimicx::tour
