#include "import/body_fit.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace mimicx::import {
namespace {

std::array<double, kBetas> random_betas(std::uint64_t seed, double size) {
  Random random(seed, {0x62657461});
  std::array<double, kBetas> betas;
  for (double& beta : betas) beta = random.uniform(-size, size);
  return betas;
}

TEST(BodyFit, MatchesTheLengthsOfABody) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const BodyLengths wanted = lengths_of(joint_offsets(random_betas(seed, 2.0)));
    const BodyLengths made = lengths_of(joint_offsets(fit_betas(wanted)));
    for (std::size_t i = 0; i < kLengths; ++i) EXPECT_NEAR(made[i], wanted[i], 0.003) << seed << ' ' << i;
  }
}

TEST(BodyFit, StandardLengthsGiveTheStandardBody) {
  for (const double beta : fit_betas(lengths_of(joint_offsets({})))) EXPECT_NEAR(beta, 0.0, 1e-9);
}

TEST(BodyFit, UnknownLengthsLeaveOtherBetasAtZero) {
  BodyLengths lengths{};
  lengths[kThigh] = 0.5;
  const auto betas = fit_betas(lengths);
  EXPECT_NEAR(lengths_of(joint_offsets(betas))[kThigh], 0.5, 0.003);
  EXPECT_EQ(betas[1], 0.0);          // girth
  EXPECT_NEAR(betas[4], 0.0, 1e-9);  // arm length
}

TEST(BodyFit, ExtremeLengthsStayWithinTheBounds) {
  BodyLengths lengths = lengths_of(joint_offsets({}));
  for (const double factor : {0.1, 0.6, 1.8, 100.0}) {
    BodyLengths scaled = lengths;
    for (double& length : scaled) length *= factor;
    for (const double beta : fit_betas(scaled)) EXPECT_LE(std::abs(beta), 5.0);
  }
}

TEST(BodyFit, RecoversTheShapeFromOffsets) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    auto betas = random_betas(seed, 4.9);
    betas[1] = 0.0;  // girth moves no joint
    double error = 1.0;
    const auto found = fit_betas(make_character(betas).joint_offset, error);
    EXPECT_LT(error, 1e-7);
    for (std::size_t k = 0; k < kBetas; ++k) EXPECT_NEAR(found[k], betas[k], 1e-4) << seed << ' ' << k;
  }
}

}  // namespace
}  // namespace mimicx::import
