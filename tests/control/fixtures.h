/// References for planning: synthetic motions, prepared as in the pipeline, and random states.
#pragma once

#include <string>

#include "control/system.h"
#include "control/tangent.h"
#include "core/random.h"
#include "motion/prepare/prepare.h"
#include "rl/tracking/tracking_clip.h"
#include "synth/synthesize.h"

namespace mimicx::control {

using rl::tracking::simulator_state;

/// A synthetic motion, cut to its first frames (0: all of it).
inline motion::Reference synthetic_reference(const std::string& kind, std::uint64_t seed,
                                             std::size_t frames = 0) {
  synth::SynthConfig options;
  options.kind = kind;
  options.seed = seed;
  motion::Reference reference = motion::prepare_reference(synth::synthesize(options), {}, nullptr);
  if (frames > 0 && frames < reference.frames.size()) {
    reference.frames.resize(frames);
    reference.poses.resize(frames);
    reference.flagged.resize(frames);
  }
  return reference;
}

inline System system_of(const motion::Reference& reference, const SimulationConfig& config = {}) {
  return make_system(reference.character, config, rl::tracking::simulator_states(reference), reference.fps);
}

/// A change of a state, every coordinate about `size`.
template <class T>
Tangent<T> random_tangent(Random& random, double size) {
  Tangent<T> delta;
  for (T& x : delta) x = T(size * random.normal());
  return delta;
}

/// A state that is moved along coordinate k.
inline State<double> moved(State<double> x, int k, double step) {
  Tangent<double> delta{};
  delta[k] = step;
  retract(x, delta);
  return x;
}

}  // namespace mimicx::control
