/// Both generators learn motions of known speed and pose.
#include <gtest/gtest.h>

#include <stdexcept>

#include "generate/code_generator.h"
#include "generate/diffusion_generator.h"
#include "generate/toy_motions.h"

namespace mimicx::generate {
namespace {

DiffusionConfig small_diffusion() {
  DiffusionConfig config;
  config.hidden = 32;
  config.levels = 6;
  config.steps = 400;
  config.minibatch = 64;
  return config;
}

CodeConfig small_codes() {
  CodeConfig config;
  config.hidden = 32;
  config.codes = 8;
  config.code_size = 4;
  config.coder_steps = config.predictor_steps = 300;
  config.minibatch = 64;
  return config;
}

/// Every label's motions have its speed and bend.
template <class Generator, class Config>
void expect_learns_the_toy(const Config& config, int frames) {
  const auto motions = toy_motions(2, 8);
  const Generator generator(motions, 2, config, 1);
  for (int label = 0; label < 2; ++label) {
    const auto made = generator.generate(label, 3);
    ASSERT_EQ(made.size(), 3u);
    for (const nn::Matrix<float>& numbers : made) {
      ASSERT_EQ(numbers.rows(), frames);
      EXPECT_NEAR(numbers.col(0).mean(), toy_speed(label), 0.005);
      EXPECT_NEAR(numbers.col(kBentNumber).mean(), toy_bend(label), 0.1);
      EXPECT_NEAR(numbers.col(3).mean(), 0.9, 0.02);
    }
  }
}

/// Equal seeds give equal bytes, however many motions are made; others do not.
template <class Generator, class Config>
void expect_depends_on_the_seed_alone(const Config& hardly_trained) {
  const auto motions = toy_motions(2, 8);
  const auto made = Generator(motions, 2, hardly_trained, 1).generate(1, 2);
  EXPECT_EQ(Generator(motions, 2, hardly_trained, 1).generate(1, 1)[0], made[0]);
  EXPECT_NE(Generator(motions, 2, hardly_trained, 2).generate(1, 1)[0], made[0]);
  EXPECT_NE(made[1], made[0]);
  EXPECT_THROW(Generator(motions, 3, hardly_trained, 1).generate(2, 1), std::invalid_argument);
  EXPECT_THROW(Generator(motions, 1, hardly_trained, 1), std::invalid_argument);
  EXPECT_THROW(Generator({}, 1, hardly_trained, 1), std::invalid_argument);
  auto brief = motions;
  brief[3].numbers = nn::Matrix<float>(motions[3].numbers.topRows(4));
  EXPECT_THROW(Generator(brief, 2, hardly_trained, 1), std::invalid_argument);
}

TEST(DiffusionGenerator, LearnsMotionsOfKnownSpeedAndPose) {
  expect_learns_the_toy<DiffusionGenerator>(small_diffusion(), 32);
}

TEST(DiffusionGenerator, DependsOnTheSeedAlone) {
  DiffusionConfig config = small_diffusion();
  config.steps = 5;
  expect_depends_on_the_seed_alone<DiffusionGenerator>(config);
}

TEST(CodeGenerator, DependsOnTheSeedAlone) {
  CodeConfig config = small_codes();
  config.coder_steps = config.predictor_steps = 5;
  expect_depends_on_the_seed_alone<CodeGenerator>(config);
}

TEST(CodeGenerator, MotionsOfALabelAreAsDifferentAsThoseThatItLearned) {
  auto motions = toy_motions(2, 8);
  for (LabelledMotion& motion : motions) motion.label = 0;  // half of them bend the knee more
  int bent = 0;
  for (const nn::Matrix<float>& numbers : CodeGenerator(motions, 1, small_codes(), 1).generate(0, 60)) {
    const float bend = numbers.col(kBentNumber).mean();
    bent += bend > 0.5F * (toy_bend(0) + toy_bend(1));
  }
  EXPECT_GT(bent, 15);
  EXPECT_LT(bent, 45);
}

TEST(CodeGenerator, LearnsMotionsOfKnownSpeedAndPose) {
  expect_learns_the_toy<CodeGenerator>(small_codes(), 32);
}

TEST(CodeGenerator, RebuildsAMotionFromItsCodes) {
  const auto motions = toy_motions(2, 8);
  const CodeGenerator generator(motions, 2, small_codes(), 1);
  const nn::Matrix<float> rebuilt = generator.rebuilt(motions.back().numbers);
  ASSERT_EQ(rebuilt.rows(), 32);
  EXPECT_LT((rebuilt - motions.back().numbers).cwiseAbs().mean(), 0.004F);
  EXPECT_NEAR(rebuilt.col(kBentNumber).mean(), toy_bend(1), 0.02);
}

TEST(CodeBook, EntriesMoveToTheMeansOfTheirVectors) {
  nn::Matrix<float> vectors(4, 1);
  vectors << -1.0F, -2.0F, 5.0F, 7.0F;
  Random random(1);
  CodeBook book(vectors, 2, random);
  while (book.nearest(vectors) != std::vector<int>{0, 0, 1, 1} &&
         book.nearest(vectors) != std::vector<int>{1, 1, 0, 0})
    book = CodeBook(vectors, 2, random);
  for (int i = 0; i < 400; ++i) book.follow(vectors, book.nearest(vectors), 0.9, random);
  const float low = book.entries().minCoeff(), high = book.entries().maxCoeff();
  EXPECT_NEAR(low, -1.5F, 1e-4F);
  EXPECT_NEAR(high, 6.0F, 1e-4F);
}

TEST(CodeBook, AnEntryWithoutVectorsBecomesOneOfThem) {
  nn::Matrix<float> first(1, 1), later(2, 1);
  first << 100.0F;
  later << 1.0F, 2.0F;
  Random random(1);
  CodeBook book(first, 2, random);
  for (int i = 0; i < 100; ++i) book.follow(later, book.nearest(later), 0.9, random);
  EXPECT_LT(book.entries().maxCoeff(), 3.0F);
  EXPECT_GT(book.entries().minCoeff(), 0.0F);
}

}  // namespace
}  // namespace mimicx::generate
