/// Motions made for the tests: smooth random ones, and simple ones whose properties are known exactly.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "motion/reference.h"

namespace mimicx::test {

inline constexpr double kPi = std::numbers::pi;
using Rotations = PerBody<Quaterniond>;

inline Vector3d random_vector(Random& random) { return {random.normal(), random.normal(), random.normal()}; }

/// Root rotation of a character that stands upright and looks along world -y.
inline Quaterniond upright() { return exp_map(kPi / 2 * Vector3d::UnitX()); }

/// Upright in the rest pose, pelvis at `height` (m) in every frame.
inline motion::Clip standing_clip(int frames, double height, double fps = 30.0) {
  motion::Clip clip;
  clip.name = "standing";
  clip.fps = fps;
  PerBody<Vector3d> rest;
  rest.fill(Vector3d::Zero());
  rest[0] = log_map(upright());
  clip.rotations.assign(static_cast<std::size_t>(frames), rest);
  clip.trans.assign(static_cast<std::size_t>(frames), Vector3d(0, 0, height) - mimicx::rest_pelvis("mimicx"));
  return clip;
}

/// The motion with both feet turned by a constant rotation, as an estimator's error would.
inline motion::Clip with_turned_feet(motion::Clip clip, const Vector3d& rotation) {
  for (auto& frame : clip.rotations)
    for (const int ankle : {kLeftAnkle, kRightAnkle})
      frame[ankle] = log_map(exp_map(frame[ankle]) * exp_map(rotation));
  return clip;
}

/// Height of the standing pelvis over its soles, m.
inline double standing_height() {
  const Character c = make_character();
  return -(c.joint_offset[kLeftHip] + c.joint_offset[kLeftKnee] + c.joint_offset[kLeftAnkle]).y() -
         c.contact_points[0].p_B.y();
}

/// Every joint swings smoothly about zero by about `amplitude` rad, slower than 1 Hz.
inline motion::Clip random_clip(std::uint64_t seed, int frames, double amplitude, double fps = 30.0) {
  Random random(seed, {0x6d6f74});
  motion::Clip clip = standing_clip(frames, standing_height(), fps);
  clip.name = "random";
  for (std::size_t j = 0; j < kBodies; ++j) {
    const Vector3d a = amplitude * random_vector(random), b = amplitude * random_vector(random);
    const double f = random.uniform(0.2, 1.0), g = random.uniform(0.2, 1.0);
    for (std::size_t t = 0; t < clip.rotations.size(); ++t) {
      const double s = static_cast<double>(t) / fps;
      const Vector3d swing = a * std::sin(2 * kPi * f * s) + b * std::cos(2 * kPi * g * s);
      clip.rotations[t][j] = log_map(exp_map(clip.rotations[t][j]) * exp_map(swing));
      if (j == 0) clip.trans[t] += 0.3 * swing;
    }
  }
  return clip;
}

}  // namespace mimicx::test
