// The example of docs/control_derivatives.md, checked against the simulator.
#include <gtest/gtest.h>

#include <memory>

#include "control/analytic/analytic.h"
#include "core/decompositions.h"
#include "physics/lanes.h"
#include "physics/test_states.h"

namespace mimicx::control {
namespace {

/// Residuals of the next target that change the pelvis' velocity by `wish` (m/s) at the end of the frame: the
/// smallest that do so to first order, Bᵀ (B Bᵀ)⁻¹ wish, B = d v / d u.
Eigen::VectorXd residuals_for(const Model<double>& model, const ControlFrame& frame, const Vector3d& wish) {
  using namespace control;
  const auto scratch = std::make_unique<FrameScratch<Pack<kLanes>>>();
  FrameDerivative<Pack<kLanes>> derivative;
  differentiate_frame(model, frame, false, *scratch, derivative);
  const Eigen::MatrixXd B = derivative.F.block(kRootVelocity, kTangent + kDofs, 3, kDofs).cast<double>();
  return B.transpose() * solve_symmetric(B * B.transpose(), wish);
}

TEST(AnalyticExample, SolvedResidualsGiveThePelvisTheDesiredVelocity) {
  const Character character = make_character();
  const Model<double> model = make_model<double>(character);
  Snapshot s = standing(character);
  s.p_root.z() -= 0.001;
  ControlFrame frame;
  set_lane(s, 0, frame.start, frame.from);
  frame.to = frame.from;
  const auto velocity = [&](const ControlFrame& f) {
    const auto scratch = std::make_unique<FrameScratch<double>>();
    FrameDerivative<double> derivative;
    differentiate_frame(model, f, false, *scratch, derivative);
    return to_eigen(derivative.end.v_root);
  };
  const Vector3d before = velocity(frame), wish(0.0, -0.005, 0.01);
  const Eigen::VectorXd u = residuals_for(model, frame, wish);
  for (int k = 0; k < kDofs; ++k) frame.to_residual[k] = u[k];
  EXPECT_LT(u.cwiseAbs().maxCoeff(), 0.1);
  EXPECT_LT((velocity(frame) - before - wish).norm(), 0.1 * wish.norm());
}

}  // namespace
}  // namespace mimicx::control
