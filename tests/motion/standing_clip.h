/// A small motion of known content: standing upright, arms down, swaying a little.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "motion/clip.h"
#include "motion/clip_file.h"
#include "motion/reference.h"

namespace mimicx::motion {

inline Clip standing_clip(int frames) {
  const Character character = make_character();
  std::vector<Vector3d> p_root;
  std::vector<PerBody<Quaterniond>> q;
  for (int t = 0; t < frames; ++t) {
    PerBody<Quaterniond> pose;
    pose.fill(Quaterniond::Identity());
    pose[kPelvis] = exp_map(Vector3d(std::numbers::pi / 2, 0.0, 0.0));
    pose[kLeftShoulder] = exp_map(Vector3d(0.0, 0.0, -1.2));
    pose[kRightShoulder] = exp_map(Vector3d(0.0, 0.0, 1.2));
    pose[kSpine2] = exp_map(Vector3d(0.03 * std::sin(0.2 * t), 0.0, 0.0));
    p_root.emplace_back(0.0, 0.0, 0.95);
    q.push_back(pose);
  }
  return to_clip("standing", 30.0, character, p_root, q);
}

}  // namespace mimicx::motion
