/// Jumps, and motions with glitches, for the tests of repair and preparation.
#pragma once

#include <algorithm>

#include "motion/made_motions.h"

namespace mimicx::test {

/// Heights of a ballistic jump that takes off at 1 s (m/s upwards, g = 9.81); 0 on the floor.
inline PerFrame<double> jump_heights(int frames, double take_off_speed) {
  PerFrame<double> z;
  for (int t = 0; t < frames; ++t) {
    const double s = t / 30.0 - 1.0;
    z.push_back(std::max(0.0, s > 0.0 ? take_off_speed * s - 0.5 * 9.81 * s * s : 0.0));
  }
  return z;
}

/// The clip with another pose in the frames [from, to).
inline motion::Clip with_glitch(motion::Clip clip, std::size_t from, std::size_t to, double size) {
  for (std::size_t t = from; t < to; ++t) clip.rotations[t][kLeftShoulder] += Vector3d(0, size, 0);
  return clip;
}

}  // namespace mimicx::test
