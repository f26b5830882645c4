/// Motions whose label is their speed and the bend of their left knee.
#pragma once

#include <vector>

#include "core/random.h"
#include "generate/pose_numbers.h"

namespace mimicx::generate {

inline constexpr int kBentNumber = 4 + 3 * kLeftKnee;
inline float toy_speed(int label) { return 0.01F + 0.02F * static_cast<float>(label); }
inline float toy_bend(int label) { return 0.3F + 0.5F * static_cast<float>(label); }

/// `count` motions of each label, 32 frames each, with hardly any noise.
inline std::vector<LabelledMotion> toy_motions(int labels, int count, std::uint64_t seed = 1) {
  Random random(seed);
  std::vector<LabelledMotion> motions;
  for (int label = 0; label < labels; ++label)
    for (int i = 0; i < count; ++i) {
      nn::Matrix<float> numbers(32, kPoseNumbers);
      for (Eigen::Index k = 0; k < numbers.size(); ++k)
        numbers.data()[k] = static_cast<float>(0.0002 * random.normal());
      numbers.col(0).array() += toy_speed(label);
      numbers.col(3).array() += 0.9F;
      numbers.col(kBentNumber).array() += toy_bend(label);
      motions.push_back({label, numbers});
    }
  return motions;
}

}  // namespace mimicx::generate
