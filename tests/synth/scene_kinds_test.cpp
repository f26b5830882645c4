#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "character/joint_range.h"
#include "core/units.h"
#include "synth/data_set.h"
#include "synth/synth_motions.h"

namespace mimicx::synth {
namespace {

const std::vector<std::string> kSteps = {"stairs_up", "stairs_down", "kerb", "box"};
const std::vector<std::string> kSeats = {"sit_down", "sit_and_reach", "lie_on_bed"};

/// One of the standard body and one of another.
const std::vector<test::Motion>& on_ground(const std::string& kind) {
  static std::map<std::string, std::vector<test::Motion>> made;
  std::vector<test::Motion>& list = made[kind];
  if (list.empty())
    for (const std::uint64_t seed : {0, 1}) {
      SynthConfig config;
      config.kind = kind;
      config.seed = seed;
      config.seconds = kind == "sit_down" || kind == "sit_and_reach" || kind == "lie_on_bed" ? 6.0 : 0.0;
      config.betas_from_seed = seed == 1;
      list.push_back(test::make_motion(config));
    }
  return list;
}

template <class Check>
void for_all_of(const std::vector<std::string>& kinds, const Check& check) {
  for (const std::string& kind : kinds)
    for (const test::Motion& motion : on_ground(kind)) {
      SCOPED_TRACE(motion.clip.name);
      check(motion);
    }
}

Vector3d lowest(const test::Motion& m, int t, int point) {
  return lowest_position(m.character.contact_points[point], m.poses[t]);
}

/// Feet that hardly move are on the ground, and on every plate one stands.
TEST(SceneKinds, StandingFeetAreOnTheirPlates) {
  for_all_of(kSteps, [](const test::Motion& m) {
    std::map<double, int> standing;
    for (int t = 1; t + 1 < m.poses.count(); ++t)
      for (int foot = 0; foot < 2; ++foot) {
        double speed = 0.0, clearance = 0.0;
        for (int i = 6 * foot; i < 6 * foot + 6; ++i) {
          speed = std::max(speed, (lowest(m, t + 1, i) - lowest(m, t - 1, i)).norm() / (2.0 * test::kDt));
          clearance = std::max(clearance, std::abs(m.clip.scene.clearance(lowest(m, t, i))));
        }
        if (speed > 0.02) continue;
        ASSERT_LT(clearance, 5e-4) << "frame " << t << ", foot " << foot;
        ++standing[m.clip.scene.height_under(lowest(m, t, 6 * foot))];
      }
    for (const Plate& plate : m.clip.scene.plates) EXPECT_GT(standing[plate.height], 4) << plate.height;
  });
}

/// Neither soles nor shins are in a box.
TEST(SceneKinds, NothingGoesThroughAPlateOrItsSides) {
  for_all_of(kSteps, [](const test::Motion& m) {
    for (int t = 0; t < m.poses.count(); ++t)
      for (int i = 0; i < m.character.contact_points.count(); ++i)
        for (const Plate& plate : m.clip.scene.plates) {
          const Vector3d p = lowest(m, t, i);
          if (!plate.spans(p)) continue;
          ASSERT_GT(p.z() - plate.height, -1e-6) << "frame " << t << ", point " << i;
        }
  });
}

TEST(SceneKinds, StairsGoUpAndDownByTheirSteps) {
  for (const test::Motion& m : on_ground("stairs_up"))
    EXPECT_NEAR(m.joint(m.frames() - 1, kPelvis).z() - m.joint(0, kPelvis).z(),
                m.clip.scene.plates.back().height, 0.02);
  for (const test::Motion& m : on_ground("stairs_down"))
    EXPECT_NEAR(m.joint(m.frames() - 1, kPelvis).z() - m.joint(0, kPelvis).z(),
                -m.clip.scene.plates.front().height, 0.02);
}

/// Hips rest on the seat, to a centimetre, and thighs on it or up to 2.5 over it (seats lower than level
/// thighs); feet are on the floor, and nothing is deep in the seat, but hands that pass its side.
TEST(SceneKinds, SeatsCarryHipsAndThighs) {
  for_all_of(kSeats, [](const test::Motion& m) {
    const Plate& seat = m.clip.scene.plates.front();
    int seated = 0;
    for (int t = 0; t < m.poses.count(); ++t) {
      bool on_it = true;
      for (int i = 0; i < m.character.contact_points.count(); ++i) {
        const int body = m.character.contact_points[i].body;
        const Vector3d p = lowest(m, t, i);
        ASSERT_GT(m.clip.scene.clearance(p), body == kLeftWrist || body == kRightWrist ? -0.06 : -0.02)
            << "frame " << t << ", " << kBodyNames[body];
        if (body == kPelvis || body == kLeftHip || body == kRightHip)
          on_it = on_it && seat.spans(p) && p.z() - seat.height > -0.01 &&
                  p.z() - seat.height < (body == kPelvis ? 0.01 : 0.025);
      }
      seated += on_it;
      for (int i = 0; i < kFootPoints; ++i) ASSERT_LT(std::abs(lowest(m, t, i).z()), 0.015) << "frame " << t;
    }
    EXPECT_GT(seated, 20);
    EXPECT_GT(m.joint(0, kPelvis).z() - seat.height, 0.3);
  });
}

/// On seats of any height that occurs, for bodies of any shape: an upright pelvis and joints inside their
/// ranges.
TEST(SceneKinds, SeatedPeopleAreUprightAndInsideTheirRanges) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    SynthConfig config;
    config.kind = "sit_down";
    config.seed = seed;
    config.betas_from_seed = true;
    const test::Motion m = test::make_motion(config);
    SCOPED_TRACE(m.clip.name);
    const std::size_t middle = m.frames() / 2;
    ASSERT_LT(m.joint(middle, kPelvis).z() - m.clip.scene.plates.front().height, 0.2) << "does not sit";
    EXPECT_GT((m.poses[middle].q_WB[kPelvis] * Vector3d::UnitY()).z(), std::cos(10.0 * kDegree));
    const PerFrame<PerBody<Quaterniond>> rotations = motion::joint_rotations(m.clip);
    for (int t = 0; t < rotations.count(); ++t)
      for (int body = 1; body < kBodies; ++body)
        ASSERT_LT(range_distance(m.character.joint[body], body, rotations[t][body]).excess, kDegree)
            << "frame " << t << ", " << kBodyNames[body];
  }
}

TEST(SceneKinds, LieOnBedRestsTheThoraxOnIt) {
  for (const test::Motion& m : on_ground("lie_on_bed")) {
    int lying = 0;
    for (std::size_t t = 0; t < m.frames(); ++t)
      lying += m.joint(t, kSpine3).z() - m.clip.scene.plates.front().height < 0.2;
    EXPECT_GT(lying, 20);
  }
}

TEST(SceneKinds, NoisyMotionKeepsTheSceneOfTheTruthToItself) {
  SynthConfig config;
  config.kind = "kerb";
  const SynthPair pair = make_synth_pair(config, {});
  EXPECT_EQ(pair.truth.scene.plates.size(), 1u);
  EXPECT_TRUE(pair.noisy.scene.flat());
}

}  // namespace
}  // namespace mimicx::synth
