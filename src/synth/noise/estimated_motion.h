/// The motion that an estimator estimates, as the noise model changes it.
#pragma once

#include "character/character.h"

namespace mimicx::synth {

struct EstimatedMotion {
  PerFrame<Vector3d> p_root;         ///< [frames] pelvis in the world, m
  PerFrame<PerBody<Quaterniond>> q;  ///< [frames][22] joints relative to the parent; entry 0: root in world

  int frames() const { return q.count(); }
};

}  // namespace mimicx::synth
