#include "motion/reference.h"

#include <algorithm>

namespace mimicx::motion {

void differentiate(PerFrame<ReferenceFrame>& frames, double fps) {
  const int last = frames.count() - 1;
  for (int t = 0; t <= last && last > 0; ++t) {
    const ReferenceFrame &before = frames[std::max(t - 1, 0)], &after = frames[std::min(t + 1, last)];
    const double rate = fps / (t > 0 && t < last ? 2.0 : 1.0);
    frames[t].v_root = rate * (after.p_root - before.p_root);
    for (int j = 0; j < kBodies; ++j)
      frames[t].omega[j] = rate * log_map(before.q[j].conjugate() * after.q[j]);
  }
}

Clip clip_on_body_of(const Clip& input, const Reference& reference, const PerFrame<ReferenceFrame>& frames) {
  PerFrame<Vector3d> p_root;
  PerFrame<PerBody<Quaterniond>> q;
  for (const ReferenceFrame& frame : frames) {
    p_root.push_back(frame.p_root);
    q.push_back(frame.q);
  }
  Clip clip = to_clip(reference.name, reference.fps, reference.character, p_root, q);
  if (input.rest_joints) put_on_body_of(input, clip);
  clip.scene = reference.scene;
  return clip;
}

}  // namespace mimicx::motion
