/// Synthetic motions for the tests of other rooms than synth's own.
#pragma once

#include <string>

#include "synth/synthesize.h"

namespace mimicx::test {

/// The exact motion of a kind and seed, cut to its first frames (0: all of it).
inline motion::Clip synthetic_clip(const std::string& kind, std::uint64_t seed, std::size_t frames = 0) {
  synth::SynthConfig config;
  config.kind = kind;
  config.seed = seed;
  motion::Clip clip = synth::synthesize(config);
  if (frames > 0) {
    clip.rotations.resize(frames);
    clip.trans.resize(frames);
  }
  return clip;
}

}  // namespace mimicx::test
