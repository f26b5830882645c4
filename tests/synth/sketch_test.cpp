#include "synth/sketch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "synth/synth_motions.h"

namespace mimicx::synth {
namespace {

test::Motion sketch(const std::string& kind, std::uint64_t seed) {
  SynthConfig config;
  config.kind = kind;
  config.seed = seed;
  config.betas_from_seed = seed == 1;
  return test::make_motion(config);
}

/// One of the standard body and one of another.
const std::vector<test::Motion>& sketches(const std::string& kind) {
  static std::map<std::string, std::vector<test::Motion>> made;
  std::vector<test::Motion>& list = made[kind];
  if (list.empty()) list = {sketch(kind, 0), sketch(kind, 1)};
  return list;
}

/// Height of the lowest point of a contact point, m.
double height(const test::Motion& m, std::size_t t, int point) {
  return lowest_position(m.character.contact_points[point], m.poses[t]).z();
}

double height(const test::Motion& m, std::size_t t, const Support& support) {
  double lowest = 1e9;
  for (const int point : support) lowest = std::min(lowest, height(m, t, point));
  return lowest;
}

/// Frames in which all of these touch the floor.
int frames_on(const test::Motion& m, const std::vector<Support>& supports) {
  int frames = 0;
  for (std::size_t t = 0; t < m.frames(); ++t)
    frames += std::all_of(supports.begin(), supports.end(),
                          [&](const Support& support) { return height(m, t, support) < 0.002; });
  return frames;
}

template <class Check>
void for_all_sketches(const Check& check) {
  for (const std::string& kind : floor_kinds())
    for (const test::Motion& motion : sketches(kind)) {
      SCOPED_TRACE(motion.clip.name);
      check(motion);
    }
}

TEST(Sketch, KneelStandsOnBothKneesWithItsTrunkUpright) {
  for (const test::Motion& m : sketches("kneel")) {
    EXPECT_GT(frames_on(m, {knee(0), knee(1)}), 45) << m.clip.name;
    EXPECT_LT(frames_on(m, {hand(0)}) + frames_on(m, {hand(1)}), 1) << m.clip.name;
  }
}

TEST(Sketch, CrawlGetsAheadOnHandsAndKnees) {
  for (const test::Motion& m : sketches("crawl")) {
    EXPECT_GT(frames_on(m, {knee(0), knee(1), hand(0), hand(1)}), 10) << m.clip.name;
    EXPECT_GT((m.com(m.frames() - 1) - m.com(0)).head<2>().norm(), 0.25) << m.clip.name;
  }
}

TEST(Sketch, LieDownLiesOnItsFront) {
  for (const test::Motion& m : sketches("lie_down")) {
    int lying = 0;
    for (std::size_t t = 0; t < m.frames(); ++t)
      lying += m.com(t).z() < 0.25 && height(m, t, front(0)) < 0.002 && height(m, t, front(1)) < 0.002;
    EXPECT_GT(lying, 15) << m.clip.name;
  }
}

/// To a centimetre; the plan does the rest.
TEST(Sketch, TouchesTheFloorInEveryFrameAndIsNeverUnderIt) {
  for_all_sketches([](const test::Motion& m) {
    for (std::size_t t = 0; t < m.frames(); ++t) {
      double lowest = 1e9;
      for (int i = 0; i < m.character.contact_points.count(); ++i) lowest = std::min(lowest, height(m, t, i));
      ASSERT_GT(lowest, -0.012) << "frame " << t;
      ASSERT_LT(lowest, 0.004) << "frame " << t;
    }
  });
}

TEST(Sketch, BeginsAndEndsAtEase) {
  for_all_sketches([](const test::Motion& m) {
    for (const std::size_t t : {std::size_t{0}, m.frames() - 1}) {
      for (const Vector3d& point : m.sole[t]) ASSERT_LT(std::abs(point.z()), 1e-6);
      ASSERT_GT(m.joint(t, kHead).z(), 1.55 * m.joint(t, kPelvis).z());
    }
  });
}

TEST(Sketch, IsSlow) {
  for_all_sketches([](const test::Motion& m) {
    for (std::size_t t = 1; t < m.frames(); ++t)
      for (int body = 0; body < kBodies; ++body)
        ASSERT_LT((m.joint(t, body) - m.joint(t - 1, body)).norm() / test::kDt, 4.0)
            << kBodyNames[body] << ", frame " << t;
  });
}

TEST(Sketch, IsByteIdenticalForEqualOptionsOnly) {
  for (const std::string& kind : floor_kinds()) {
    const std::vector<test::Motion>& made = sketches(kind);
    EXPECT_GT((made[0].clip.rotations[30][kPelvis] - made[1].clip.rotations[30][kPelvis]).norm(), 1e-3);
  }
  const motion::Clip &once = sketches("kneel")[0].clip, again = sketch("kneel", 0).clip;
  EXPECT_TRUE(once.rotations == again.rotations && once.trans == again.trans);
}

}  // namespace
}  // namespace mimicx::synth
