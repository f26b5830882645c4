#include "import/evidence/translation_unit.h"

#include <gtest/gtest.h>

#include "motion/made_motions.h"
#include "synth/synthesize.h"

namespace mimicx::import {
namespace {

motion::Clip made(const std::string& kind, double unit) {
  synth::SynthConfig config;
  config.kind = kind;
  config.seed = 3;
  motion::Clip clip = synth::synthesize(config);
  clip.body_model = "smplx";
  clip.betas = {};
  for (Vector3d& trans : clip.trans) trans /= unit;
  return clip;
}

TEST(TranslationUnit, AWalkTellsItsUnit) {
  for (const auto& [name, unit] : {std::pair{"metres", 1.0},
                                   {"decimetres", 0.1},
                                   {"centimetres", 0.01},
                                   {"millimetres", 0.001},
                                   {"inches", 0.0254},
                                   {"feet", 0.3048}}) {
    const TranslationUnit found = decide_translation_unit(made("walk", unit));
    EXPECT_EQ(found.name, name);
    EXPECT_EQ(found.near, "") << name;
  }
}

TEST(TranslationUnit, ACrawlTellsItsUnitWhereverTheOriginIs) {
  // The floor is at 0; a wall from which the trunk points away is no floor.
  motion::Clip crawl = made("crawl", 0.1);
  constexpr int kFirst = 138, kLast = 361;  // on hands and knees
  crawl.trans.assign(crawl.trans.begin() + kFirst, crawl.trans.begin() + kLast);
  crawl.rotations.assign(crawl.rotations.begin() + kFirst, crawl.rotations.begin() + kLast);
  for (const double metres : {-1.0, 0.0, 1.0}) {
    motion::Clip moved = crawl;
    for (Vector3d& trans : moved.trans) trans.x() += metres / 0.1;
    EXPECT_EQ(decide_translation_unit(moved).name, "decimetres") << metres;
  }
}

TEST(TranslationUnit, GlidingAtFiveMetresPerSecondStaysInMetres) {
  // Upright without a step, at 5 m/s: in millimetres the feet would rest, but the floor would be at −0.9 m.
  motion::Clip clip = test::standing_clip(90, test::standing_height());
  for (std::size_t t = 0; t < clip.trans.size(); ++t)
    clip.trans[t].x() += 5.0 / 30.0 * static_cast<double>(t);
  clip.body_model = "smplx";
  EXPECT_EQ(decide_translation_unit(clip).name, "metres");
}

TEST(TranslationUnit, OnATreadmillNothingTellsOfAnotherUnit) {
  motion::Clip clip = made("walk", 1.0);
  for (Vector3d& trans : clip.trans) trans.head<2>().setZero();
  EXPECT_EQ(decide_translation_unit(clip).name, "metres");
}

TEST(TranslationUnit, SomebodyStillOnAStageIsNotScaled) {
  motion::Clip clip = test::standing_clip(60, test::standing_height() + 2.0);
  clip.body_model = "smplx";
  const TranslationUnit found = decide_translation_unit(clip);
  EXPECT_EQ(found.name, "metres");
  EXPECT_EQ(found.near, "feet") << "which puts the floor at 0";
}

}  // namespace
}  // namespace mimicx::import
