/// Synthetic motions for the tests of other rooms than synth's own.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "synth/synthesize.h"

namespace mimicx::test {

/// The exact motion of a kind and seed, cut to its first frames (0: all of it).
inline motion::Clip synthetic_clip(const std::string& kind, std::uint64_t seed, std::size_t frames = 0) {
  static std::map<std::pair<std::string, std::uint64_t>, motion::Clip> made;
  const auto [entry, is_new] = made.try_emplace({kind, seed});
  if (is_new) {
    synth::SynthConfig config;
    config.kind = kind;
    config.seed = seed;
    entry->second = synth::synthesize(config);
  }
  motion::Clip clip = entry->second;
  if (frames > 0) {
    clip.rotations.resize(frames);
    clip.trans.resize(frames);
  }
  return clip;
}

}  // namespace mimicx::test
