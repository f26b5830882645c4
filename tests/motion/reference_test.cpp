#include "motion/reference.h"

#include <gtest/gtest.h>

#include "motion/made_motions.h"
#include "motion/prepare/prepare.h"

namespace mimicx::motion {
namespace {

TEST(Differentiate, ConstantRatesAreExact) {
  const Vector3d velocity(0.5, -1, 0.25), spin = 2.0 * Vector3d(1, 2, -1).normalized();
  PerFrame<ReferenceFrame> frames(20);
  for (std::size_t t = 0; t < frames.size(); ++t) {
    const double s = static_cast<double>(t) / 30.0;
    frames[t].p_root = s * velocity;
    frames[t].q.fill(exp_map(Vector3d(0.3, 0.1, -2)) * exp_map(s * spin));
  }
  differentiate(frames, 30.0);
  for (const ReferenceFrame& f : frames) {
    EXPECT_LT((f.v_root - velocity).norm(), 1e-12);
    for (const Vector3d& w : f.omega) EXPECT_LT((w - spin).norm(), 1e-10);
  }
}

/// R(t) = Rz(a)·Rx(b) has the body rate ḃ x + ȧ Rx(b)ᵀ z.
TEST(Differentiate, ConvergesQuadraticallyToTheBodyRateOfAnAnalyticRotation) {
  const auto a = [](double s) { return 1.5 * std::sin(2.0 * s); };
  const auto b = [](double s) { return 0.8 * std::cos(3.0 * s); };
  double previous = 0.0;
  for (const double fps : {30.0, 60.0, 120.0}) {
    PerFrame<ReferenceFrame> frames(static_cast<std::size_t>(2 * fps));
    for (std::size_t t = 0; t < frames.size(); ++t) {
      const double s = static_cast<double>(t) / fps;
      frames[t].q.fill(rotation_z(a(s)) * exp_map(b(s) * Vector3d::UnitX()));
    }
    differentiate(frames, fps);
    double worst = 0.0;
    for (std::size_t t = 1; t + 1 < frames.size(); ++t) {
      const double s = static_cast<double>(t) / fps, da = 3.0 * std::cos(2.0 * s),
                   db = -2.4 * std::sin(3.0 * s);
      const Vector3d exact =
          db * Vector3d::UnitX() + da * (exp_map(-b(s) * Vector3d::UnitX()) * Vector3d::UnitZ());
      worst = std::max(worst, (frames[t].omega[kLeftHip] - exact).norm());
    }
    if (previous > 0.0) {
      EXPECT_NEAR(previous / worst, 4.0, 0.3);
    }
    previous = worst;
  }
}

TEST(Differentiate, IntegratesBackToTheMotion) {
  // The simulator's step: q(t+dt) ≈ q(t)·exp(dt·ω) with the mean of the rates of both ends.
  PreparationConfig config;
  config.ranges = false;  // this motion leaves them, and corrections for it bend
  const Reference r = prepare_reference(test::random_clip(3, 60, 0.4), config, nullptr);
  for (std::size_t t = 1; t + 2 < r.frames.size(); ++t) {
    const ReferenceFrame &f = r.frames[t], &next = r.frames[t + 1];
    EXPECT_LT((f.p_root + 0.5 / 30.0 * (f.v_root + next.v_root) - next.p_root).norm(), 0.003);
    for (const std::size_t j : std::initializer_list<std::size_t>{kPelvis, kSpine1, kNeck, kLeftCollar})
      EXPECT_LT((f.q[j] * exp_map(0.5 / 30.0 * (f.omega[j] + next.omega[j]))).angularDistance(next.q[j]),
                0.02);
  }
}

}  // namespace
}  // namespace mimicx::motion
