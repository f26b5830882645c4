#include "generate/recogniser.h"

#include <gtest/gtest.h>

#include "core/units.h"
#include "generate/toy_motions.h"

namespace mimicx::generate {
namespace {

nn::Matrix<float> normal_rows(int rows, int cols, std::uint64_t seed) {
  Random random(seed);
  nn::Matrix<float> m(rows, cols);
  for (Eigen::Index i = 0; i < m.size(); ++i) m.data()[i] = static_cast<float>(random.normal());
  return m;
}

TEST(FrechetDistance, OfEqualRowsIsZero) {
  const nn::Matrix<float> a = normal_rows(50, 4, 1);
  EXPECT_NEAR(frechet_distance(a, a), 0.0, 1e-6);
}

TEST(FrechetDistance, OfScaledAndMovedRowsIsThatOfTheFormula) {
  const nn::Matrix<float> a = normal_rows(50, 4, 1);
  nn::Matrix<float> b = 3.0F * a;
  b.col(0).array() += 2.0F;
  const Eigen::MatrixXd x = a.cast<double>();
  const Eigen::RowVectorXd mean = x.colwise().mean();
  const double variance = (x.rowwise() - mean).squaredNorm() / 49.0;
  Eigen::RowVectorXd between = 2.0 * mean;
  between[0] += 2.0;
  // C₂ = 9 C₁: tr(C₁ + 9 C₁ − 2 · 3 C₁) = 4 tr C₁.
  EXPECT_NEAR(frechet_distance(a, b), between.squaredNorm() + 4.0 * variance, 1e-4);
  EXPECT_NEAR(frechet_distance(b, a), frechet_distance(a, b), 1e-4);
}

Recogniser trained_on_toys() {
  RecogniserConfig config;
  config.steps = 300;
  config.noise = 0.1;
  return {toy_motions(4, 10, 1), 4, config, 1};
}

TEST(Recogniser, KnowsTheLabelsOfMotionsThatItHasNotSeen) {
  const auto test = toy_motions(4, 5, 2);
  const Recogniser recogniser = trained_on_toys();
  const GenerationScores scores = recogniser.scores(test, test);
  EXPECT_NEAR(scores.precision[0], 1.0, 1e-12);
  EXPECT_NEAR(scores.precision[2], 1.0, 1e-12);
  EXPECT_NEAR(scores.fid, 0.0, 1e-3);
  EXPECT_GT(scores.diversity, scores.multimodal_distance);

  auto wrong = test;
  for (LabelledMotion& motion : wrong) motion.label = (motion.label + 1) % 4;
  const GenerationScores of_wrong = recogniser.scores(wrong, test);
  EXPECT_EQ(of_wrong.precision[0], 0.0);
  EXPECT_LE(of_wrong.precision[1], of_wrong.precision[2]);
  EXPECT_GT(of_wrong.multimodal_distance, scores.multimodal_distance);
  EXPECT_NEAR(of_wrong.diversity, scores.diversity, 1e-9);

  auto one = toy_motions(4, 5, 2);
  for (LabelledMotion& motion : one) motion.numbers = test[0].numbers;
  const GenerationScores of_one = recogniser.scores(one, test);
  EXPECT_NEAR(of_one.diversity, 0.0, 1e-5);
  EXPECT_GT(of_one.fid, 1.0);
}

// Exact motions hardly move their wrists. Measured by that, half a degree would count as much as ten do.
TEST(Recogniser, TinyErrorsOfNumbersThatAreConstantCountLittle) {
  const auto test = toy_motions(4, 5, 2);
  const Recogniser recogniser = trained_on_toys();
  const auto fid_with_wrists_turned_by = [&](double degrees) {
    auto turned = test;
    for (LabelledMotion& motion : turned)
      motion.numbers.middleCols(4 + 3 * kLeftWrist, 6).array() += static_cast<float>(degrees * kDegree);
    return recogniser.scores(turned, test).fid;
  };
  EXPECT_LT(fid_with_wrists_turned_by(0.5), 0.2 * fid_with_wrists_turned_by(10.0));
}

}  // namespace
}  // namespace mimicx::generate
