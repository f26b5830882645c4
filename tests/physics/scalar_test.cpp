// Packs, and vectors and matrices over them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "physics/test_states.h"

namespace mimicx::physics {
namespace {

template <class P>
class PackTest : public testing::Test {};
using Widths = testing::Types<Pack<4>, Pack<8>, Pack<16>>;
TYPED_TEST_SUITE(PackTest, Widths);

template <class P>
P random_pack(Random& random) {
  P p;
  for (int lane = 0; lane < P::kSize; ++lane) p.set(lane, static_cast<float>(random.normal()));
  return p;
}

TYPED_TEST(PackTest, OperationsAreIeeeExactInEveryLane) {
  using P = TypeParam;
  Random random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const P a = random_pack<P>(random), b = random_pack<P>(random), c = random_pack<P>(random);
    const P sum = a + b, product = a * b, quotient = a / b, root = sqrt(a * a), fused = fma(a, b, c);
    const P low = min(a, b), high = max(a, b), chosen = select<P::kSize>(a < b, c, -c);
    for (int i = 0; i < P::kSize; ++i) {
      EXPECT_EQ(sum[i], a[i] + b[i]);
      EXPECT_EQ(product[i], a[i] * b[i]);
      EXPECT_EQ(quotient[i], a[i] / b[i]);
      EXPECT_EQ(root[i], std::sqrt(a[i] * a[i]));
#if defined(MIMICX_FUSED)
      EXPECT_EQ(fused[i], std::fma(a[i], b[i], c[i]));
#else
      EXPECT_EQ(fused[i], a[i] * b[i] + c[i]);
#endif
      EXPECT_EQ(low[i], std::min(a[i], b[i]));
      EXPECT_EQ(high[i], std::max(a[i], b[i]));
      EXPECT_EQ(chosen[i], a[i] < b[i] ? c[i] : -c[i]);
    }
  }
}

TYPED_TEST(PackTest, AnySeesEverySingleLane) {
  using P = TypeParam;
  EXPECT_FALSE(any(P(0.0) > P(0.0)));
  for (int i = 0; i < P::kSize; ++i) {
    P p(0.0);
    p.set(i, 1.0f);
    EXPECT_TRUE(any(p > P(0.0))) << i;
  }
}

/// Largest error of the pack's exp and log against double over all angles up to `limit`.
TYPED_TEST(PackTest, ExpAndLogAreAccurateToFloatRounding) {
  using P = TypeParam;
  Random random(12);
  for (int trial = 0; trial < 2000; ++trial) {
    const double angle = random.uniform(0.0, 0.999 * std::numbers::pi);
    const Vector3d r = angle * random_vector(random).normalized();
    Vec3<P> rotation{P(0.0), P(0.0), P(0.0)};
    const int lane = trial % P::kSize;
    set_lane(rotation, lane, r);
    const Quat<P> q = exp_map(rotation);
    EXPECT_LT((lane_of(q, lane).coeffs() - exp_map(r).coeffs()).norm(), 4e-7) << angle;
    Quat<P> exact{P(1.0), P(0.0), P(0.0), P(0.0)};
    set_lane(exact, lane, exp_map(r));
    EXPECT_LT((lane_of(log_map(exact), lane) - r).norm(), 2e-6) << angle;
    // The other quaternion of the same rotation has the same logarithm.
    const Quat<P> other{-exact.w, -exact.x, -exact.y, -exact.z};
    EXPECT_LT((lane_of(log_map(other), lane) - r).norm(), 2e-6) << angle;
  }
}

TYPED_TEST(PackTest, OtherLanesOfExpAndLogStayAtTheIdentity) {
  using P = TypeParam;
  Vec3<P> rotation{P(0.0), P(0.0), P(0.0)};
  set_lane(rotation, 1, {1.0, 2.0, -0.5});
  const Vec3<P> back = log_map(exp_map(rotation));
  for (int lane = 0; lane < P::kSize; ++lane)
    if (lane != 1) {
      EXPECT_EQ(lane_of(back, lane), Vector3d(Vector3d::Zero()));
    }
}

Vec3<double> vec(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Quat<double> quat(const Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }
Matrix3d full(const Sym3<double>& s) {
  Matrix3d m;
  m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
  return m;
}
Matrix3d full(const Mat3<double>& m) {
  Matrix3d out;
  for (int k = 0; k < 3; ++k) out.col(k) = lane_of(m.c[k], 0);
  return out;
}

TEST(Spatial, VectorsMatricesAndQuaternionsAgreeWithEigen) {
  Random random(13);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3d a = random_vector(random), b = random_vector(random);
    const Quaterniond p = exp_map(random_vector(random)), q = exp_map(random_vector(random));
    EXPECT_LT((lane_of(cross(vec(a), vec(b)), 0) - a.cross(b)).norm(), 1e-14);
    EXPECT_NEAR(dot(vec(a), vec(b)), a.dot(b), 1e-14);
    EXPECT_LT((lane_of(quat(p) * quat(q), 0).coeffs() - (p * q).coeffs()).norm(), 1e-15);
    const Mat3<double> R = to_matrix(quat(p));
    EXPECT_LT((full(R) - p.toRotationMatrix()).norm(), 1e-14);
    EXPECT_LT((lane_of(R * vec(a), 0) - p * a).norm(), 1e-14);
    EXPECT_LT((lane_of(transpose_times(R, vec(a)), 0) - p.conjugate() * a).norm(), 1e-14);
    Matrix3d root;
    root << random_vector(random), random_vector(random), random_vector(random);
    const Matrix3d S = root * root.transpose() + Matrix3d::Identity();
    const Sym3<double> s{S(0, 0), S(0, 1), S(0, 2), S(1, 1), S(1, 2), S(2, 2)};
    EXPECT_LT((full(inverse(s)) * S - Matrix3d::Identity()).norm(), 1e-11);
    EXPECT_LT((full(congruence(R, s)) - p.toRotationMatrix() * S * p.toRotationMatrix().transpose()).norm(),
              1e-12);
    EXPECT_LT((lane_of(s * vec(a), 0) - S * a).norm(), 1e-12);
  }
}

TEST(Spatial, RenormalisationRemovesDriftToSecondOrder) {
  const Quaterniond q = exp_map(Vector3d(0.3, -1.0, 0.4));
  Quat<double> drifted = quat(q);
  const double drift = 1e-4;
  for (double* x : {&drifted.w, &drifted.x, &drifted.y, &drifted.z}) *x *= 1.0 + drift;
  EXPECT_LT((lane_of(renormalised(drifted), 0).coeffs() - q.coeffs()).norm(), 2 * drift * drift);
}

}  // namespace
}  // namespace mimicx::physics
