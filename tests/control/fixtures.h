/// References for planning: synthetic motions, prepared as in the pipeline, and random states.
#pragma once

#include <memory>
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

/// A state of which every coordinate is moved by about `size`.
inline State<double> moved_at_random(State<double> x, std::uint64_t seed, double size) {
  Random random(seed);
  retract(x, random_tangent<double>(random, size));
  return x;
}

/// Kinematics of a state by the system's exact model.
inline std::unique_ptr<Data<double>> exact_kinematics(const System& system, const State<double>& x) {
  auto d = std::make_unique<Data<double>>();
  update_kinematics(system.exact_model, x, *d);
  return d;
}

/// A state that is moved along coordinate k.
inline State<double> moved(State<double> x, int k, double step) {
  Tangent<double> delta{};
  delta[k] = step;
  retract(x, delta);
  return x;
}

}  // namespace mimicx::control
