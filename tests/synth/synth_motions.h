/// Synthetic motions as the tests look at them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "synth/synthesize.h"

namespace mimicx::test {

inline constexpr double kG = 9.81, kDt = 1.0 / 30.0;

/// A clip as the tests look at it: everything from its own rotations by forward kinematics.
struct Motion {
  std::string kind;
  motion::Clip clip;
  Character character;
  PerFrame<BodyPoses> poses;
  std::vector<std::array<Vector3d, 12>> sole;  ///< heel, ball and toe of both feet

  Vector3d joint(std::size_t t, int body) const { return poses[t].p_WB[body]; }
  Vector3d mass_center(std::size_t t, std::size_t b) const {
    return poses[t].p_WB[b] + poses[t].q_WB[b] * character.com_B[b];
  }
  Vector3d com(std::size_t t) const {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t b = 0; b < kBodies; ++b) sum += character.mass[b] * mass_center(t, b);
    return sum / character.total_mass();
  }
  double lowest(std::size_t t) const {
    double z = 1e9;
    for (const Vector3d& point : sole[t]) z = std::min(z, point.z());
    return z;
  }
  std::size_t frames() const { return poses.size(); }

  void add(const Vector3d& p_root, const PerBody<Quaterniond>& q) {
    poses.push_back(forward_kinematics(character, p_root, q));
    sole.emplace_back();
    for (std::size_t i = 0; i < kFootPoints; ++i) {
      const ContactPoint& point = character.contact_points[i];
      sole.back()[i] = poses.back().p_WB[point.body] + poses.back().q_WB[point.body] * sole_point(point);
    }
  }
};

inline Motion make_motion(const synth::SynthConfig& config) {
  Motion m{config.kind, synth::synthesize(config), {}, {}, {}};
  m.character = make_character(m.clip.betas);
  for (std::size_t t = 0; t < m.clip.rotations.size(); ++t) {
    PerBody<Quaterniond> q;
    for (std::size_t b = 0; b < kBodies; ++b) q[b] = exp_map(m.clip.rotations[t][b]);
    m.add(m.clip.trans[t] + mimicx::rest_pelvis("mimicx"), q);
  }
  return m;
}

/// Two seeds of the standard body and two of other bodies, of one kind or of all.
inline const std::vector<Motion>& motions(const std::string& kind) {
  static std::map<std::string, std::vector<Motion>> cache;
  std::vector<Motion>& list = cache[kind];
  if (list.empty())
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      synth::SynthConfig config;
      config.kind = kind;
      config.seed = seed;
      config.betas_from_seed = seed >= 2;
      list.push_back(make_motion(config));
    }
  return list;
}
template <class Check>
void for_all(const Check& check) {
  for (const std::string& kind : synth::synthetic_kinds())
    for (const Motion& motion : motions(kind)) {
      SCOPED_TRACE(motion.clip.name);
      check(motion);
    }
}

}  // namespace mimicx::test
