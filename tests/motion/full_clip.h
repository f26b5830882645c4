/// A clip that has one of everything a file can hold.
#pragma once

#include "motion/made_motions.h"

namespace mimicx::test {

/// poses[t][c] = 100 t + c / 1000, so that every element shows its origin.
inline NpyArray counted(std::size_t rows, std::size_t columns, double offset = 0.0) {
  std::vector<double> values;
  for (std::size_t t = 0; t < rows; ++t)
    for (std::size_t c = 0; c < columns; ++c)
      values.push_back(100.0 * static_cast<double>(t) + static_cast<double>(c) / 1000.0 + offset);
  return NpyArray::from_double({rows, columns}, values.data());
}

inline motion::Clip clip_with_everything() {
  motion::Clip clip = random_clip(4, 5, 0.5);
  clip.fps = 29.97;
  clip.betas = {0.5, -1.25, 0, 0, 0, 0, 0, 0, 0, 3};
  clip.gender = "female";
  motion::Keypoints k;
  k.names = {"nose", "left_ankle"};
  k.uvc.assign(5, {Vector3d(10.5, 20.25, 0.9), Vector3d(-1, 2, 0)});
  k.intrinsics << 800, 0, 320, 0, 810, 240, 0, 0, 1;
  k.extrinsics.assign(5, Eigen::Matrix4d::Identity());
  k.extrinsics[3](0, 3) = 4.5;
  clip.keypoints = k;
  clip.passthrough.emplace_back("pose_hand", counted(5, 90));
  return clip;
}

}  // namespace mimicx::test
