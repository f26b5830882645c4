// Smoothed derivatives of a control frame against central differences in double.
#include "control/differences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "control/fixtures.h"

namespace mimicx::control {
namespace {

/// One control frame in double, with an independent conversion of controls to targets.
State<double> frame_in_double(const System& system, const Model<double>& model, const FramePoint& point,
                              int column, double step) {
  Tangent<double> delta{};
  if (column < kTangent) delta[static_cast<std::size_t>(column)] = step;
  const auto target = [&](int frame, const Control& u, int first) {
    Target<double> out{};
    PerBody<Vector3d> turn;
    turn.fill(Vector3d::Zero());
    for (int k = 0; k < kDofs; ++k) {
      const Dof& dof = dofs()[static_cast<std::size_t>(k)];
      const double value =
          static_cast<double>(u[static_cast<std::size_t>(k)]) + (first + k == column ? step : 0.0);
      turn[static_cast<std::size_t>(dof.body)] += value * dof.axis;
    }
    for (std::size_t i = 1; i < kBodies; ++i) {
      out.q[i] = from_eigen(Quaterniond(to_eigen(system.at(frame).q[i]) * exp_map(turn[i])));
      out.omega[i] = system.at(frame).omega[i];
    }
    return out;
  };
  Eigen::Matrix<double, 6, 1> assistance;
  for (int k = 0; k < kAssistance; ++k)
    assistance[k] = static_cast<double>(point.u[static_cast<std::size_t>(kDofs + k)]) +
                    (column == kMemory + kDofs + k ? step : 0.0);
  const double inertia = system.mass * kAssistanceRadius * kAssistanceRadius;
  const Wrench<double> wrench{from_eigen(Vector3d(inertia * assistance.tail<3>())),
                              from_eigen(Vector3d(system.mass * assistance.head<3>()))};
  State<double> x = point.x;
  retract(x, delta);
  const auto data = std::make_unique<Data<double>>();
  const Target<double> from = target(point.frame, point.before, kTangent),
                       to = target(point.frame + 1, point.u, kMemory);
  advance_interval<double>(model, {from, to, system.substeps, system.assisted ? &wrench : nullptr}, x, *data);
  return x;
}

Eigen::MatrixXd in_double(const System& system, const Character& character, const FramePoint& point) {
  const Model<double> model = make_model<double>(character, system.model.config);
  Eigen::MatrixXd F(kTangent, kMemory + system.controls());
  const double h = 1e-6;
  for (int k = 0; k < F.cols(); ++k) {
    const Tangent<double> d =
        difference(frame_in_double(system, model, point, k, h), frame_in_double(system, model, point, k, -h));
    for (int row = 0; row < kTangent; ++row) F(row, k) = d[static_cast<std::size_t>(row)] / (2 * h);
  }
  return F;
}

/// Median over columns first … last − 1 of ‖column − exact‖ / ‖exact‖.
double median_error(const FrameMatrix& F, const Eigen::MatrixXd& exact, int first, int last) {
  std::vector<double> errors;
  for (int k = first; k < last; ++k)
    errors.push_back((F.col(k).cast<double>() - exact.col(k)).norm() / exact.col(k).norm());
  std::nth_element(errors.begin(), errors.begin() + static_cast<long>(errors.size() / 2), errors.end());
  return errors[errors.size() / 2];
}

struct SquattingScene {
  motion::Reference reference = synthetic_reference("squat", 501, 40);
  System system = system_of(reference);
  FramePoint point{20, system.at(20), {}, {}};

  explicit SquattingScene(double height) {
    Random random(45);
    system.assisted = true;
    point.x.p_root.z += height;
    for (std::size_t k = 0; k < kDofs; ++k) {
      point.before[k] = static_cast<float>(0.02 * random.normal());
      point.u[k] = static_cast<float>(0.02 * random.normal());
    }
    point.u[kDofs + 1] = 0.5f;
    point.u[kDofs + 5] = -0.7f;
  }
};

TEST(Differences, SmoothedAgreeWithDoubleInTheAir) {
  const SquattingScene s(0.5);
  const FrameMatrix F = linearise_smoothed(s.system, s.point, {});
  const Eigen::MatrixXd exact = in_double(s.system, s.reference.character, s.point);
  ASSERT_EQ(F.cols(), kMemory + kMaxControls);
  EXPECT_LT(median_error(F, exact, 0, kTangent), 0.02);
  EXPECT_LT(median_error(F, exact, kTangent, kMemory), 0.02);
  EXPECT_LT(median_error(F, exact, kMemory, kMemory + kMaxControls), 0.02);
}

TEST(Differences, UnassistedSystemsHaveNoColumnsForAssistiveForces) {
  SquattingScene s(0.0);
  const FrameMatrix assisted = linearise_smoothed(s.system, s.point, {});
  s.system.assisted = false;
  s.point.u[kDofs + 1] = s.point.u[kDofs + 5] = 0.0f;
  EXPECT_EQ(linearise_smoothed(s.system, s.point, {}).cols(), kMemory + kDofs);
  EXPECT_EQ(assisted.cols(), kMemory + kMaxControls);
}

}  // namespace
}  // namespace mimicx::control
