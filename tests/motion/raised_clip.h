/// A motion and its scene raised: on one wide plate everything is as on the floor, only higher.
#pragma once

#include "motion/clip.h"

namespace mimicx::test {

inline constexpr double kRaised = 0.25;  ///< m

inline Scene wide_plate() { return {{{{0.5, -0.5}, 0.4, {50.0, 50.0}, kRaised}}}; }

inline motion::Clip raised(motion::Clip clip) {
  for (Vector3d& trans : clip.trans) trans.z() += kRaised;
  clip.scene = wide_plate();
  return clip;
}

}  // namespace mimicx::test
