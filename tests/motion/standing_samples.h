/// Motions as the metrics see them.
#pragma once

#include "motion/made_motions.h"
#include "motion/metrics.h"

namespace mimicx::test {

inline motion::MotionSamples samples_of(const motion::Clip& clip) {
  return motion::sample_motion(make_character(clip.usable_betas()), motion::poses_of(clip), clip.fps);
}

/// Standing still on the floor.
inline motion::MotionSamples standing_samples(int frames) {
  return samples_of(standing_clip(frames, standing_height()));
}

}  // namespace mimicx::test
