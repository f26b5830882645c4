#include "import/body_fit.h"

#include <Eigen/Core>
#include <algorithm>

#include "core/decompositions.h"

namespace mimicx::import {
namespace {

using Betas = Array<double, kBetas>;

using Vector = Eigen::VectorXd;

/// Minimises ‖r(β)‖² + weight ‖β‖² within the bounds by projected Gauss-Newton steps; r by finite
/// differences, exact where r is affine.
template <class Residual>
Betas minimise(const Residual& residual, double weight) {
  constexpr int kSteps = 8;
  constexpr double kDifference = 0.01;
  Betas betas{};
  for (int step = 0; step < kSteps; ++step) {
    const Vector r = residual(betas);
    Eigen::MatrixXd J(r.size(), kBetas);
    for (int k = 0; k < kBetas; ++k) {
      Betas moved = betas;
      double& beta = moved[k];
      const double h = beta > 0.0 ? -kDifference : kDifference;  // stays within the bounds
      beta += h;
      J.col(k) = (residual(moved) - r) / h;
    }
    const Vector b = Eigen::Map<const Vector>(betas.data(), kBetas);
    // A component at its bound that wants to pass it is held, so that the others make up for it.
    Eigen::MatrixXd A = J.transpose() * J + weight * Eigen::MatrixXd::Identity(kBetas, kBetas);
    Vector g = J.transpose() * r + weight * b;
    for (int k = 0; k < kBetas; ++k)
      if (std::abs(b[k]) >= kMaxBeta && g[k] * b[k] < 0.0) {
        A.row(k).setZero();
        A.col(k).setZero();
        A(k, k) = 1.0;
        g[k] = 0.0;
      }
    const Vector next = b - solve_symmetric(A, g);
    for (int k = 0; k < kBetas; ++k) betas[k] = std::clamp(next[k], -kMaxBeta, kMaxBeta);
  }
  return betas;
}

}  // namespace

BodyLengths lengths_of(const PerBody<Vector3d>& offset) {
  const auto mean = [&](int left, int right) { return 0.5 * (offset[left].norm() + offset[right].norm()); };
  const Vector3d hips = 0.5 * (offset[kLeftHip] + offset[kRightHip]);
  const Vector3d chest = offset[kSpine1] + offset[kSpine2] + offset[kSpine3];
  const Vector3d left = offset[kLeftCollar] + offset[kLeftShoulder],
                 right = offset[kRightCollar] + offset[kRightShoulder];
  BodyLengths lengths;
  lengths[kThigh] = mean(kLeftKnee, kRightKnee);
  lengths[kShank] = mean(kLeftAnkle, kRightAnkle);
  lengths[kFootLength] = mean(kLeftFoot, kRightFoot);
  lengths[kUpperArm] = mean(kLeftElbow, kRightElbow);
  lengths[kForearm] = mean(kLeftWrist, kRightWrist);
  lengths[kHipWidth] = (offset[kLeftHip] - offset[kRightHip]).norm();
  lengths[kShoulderWidth] = (left - right).norm();
  lengths[kTrunk] = (chest + 0.5 * (left + right) - hips).norm();
  return lengths;
}

std::array<double, kBetas> fit_betas(const BodyLengths& lengths) {
  // A length that is off by 8 mm costs as much as β_k = 5: an odd skeleton gets an ordinary body that misses
  // its lengths by some millimetres.
  constexpr double kSigma = 0.005, kPull = 0.1;
  return minimise(
      [&](const Betas& betas) {
        const BodyLengths made = lengths_of(joint_offsets(betas));
        Vector r = Vector::Zero(kLengths);
        for (int i = 0; i < kLengths; ++i)
          if (lengths[i] > 0.0) r[i] = (made[i] - lengths[i]) / kSigma;
        return r;
      },
      kPull);
}

std::array<double, kBetas> fit_betas(const PerBody<Vector3d>& offsets, double& error) {
  const auto residual = [&](const Betas& betas) {
    const PerBody<Vector3d> made = joint_offsets(betas);
    Vector r(3 * kJoints);
    for (int j = 1; j < kBodies; ++j) r.segment<3>(3 * (j - 1)) = made[j] - offsets[j];
    return r;
  };
  const Betas betas = minimise(residual, 1e-12);  // the girth, which moves no joint, is 0
  error = residual(betas).cwiseAbs().maxCoeff();
  return betas;
}

}  // namespace mimicx::import
