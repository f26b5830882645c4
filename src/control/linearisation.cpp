#include "control/linearisation.h"

#include <utility>

namespace mimicx::control {
namespace {

Target<double> reference_target(const System& system, int frame) {
  Target<double> target{};
  target.q = system.at(frame).q;
  target.omega = system.at(frame).omega;
  if (!system.velocity_feed_forward) target.omega.fill(zero3<double>());
  return target;
}

}  // namespace

FrameMatrix linearise(const System& system, const FramePoint& point, LinearisationScratch& scratch) {
  ControlFrame frame;
  frame.start = point.x;
  frame.from = reference_target(system, point.frame);
  frame.to = reference_target(system, point.frame + 1);
  for (std::size_t k = 0; k < kDofs; ++k) {
    frame.from_residual[k] = static_cast<double>(point.before[k]);
    frame.to_residual[k] = static_cast<double>(point.u[k]);
  }
  const double inertia = system.mass * kAssistanceRadius * kAssistanceRadius;
  const auto assistance = [&](std::size_t k) { return static_cast<double>(point.u[kDofs + k]); };
  if (system.assisted)
    frame.assistance = {
        {inertia * assistance(3), inertia * assistance(4), inertia * assistance(5)},
        {system.mass * assistance(0), system.mass * assistance(1), system.mass * assistance(2)}};
  frame.substeps = system.substeps;
  differentiate_frame(system.exact_model, frame, system.assisted, scratch.frame, scratch.derivative);
  FrameMatrix F = std::move(scratch.derivative.F);
  if (system.assisted) {  // F has moment before force there, and no accelerations
    const Eigen::Matrix<float, kTangent, kAssistance> assistance = F.rightCols<kAssistance>();
    F.middleCols<3>(kFrameColumns) = static_cast<float>(system.mass) * assistance.rightCols<3>();
    F.rightCols<3>() = static_cast<float>(inertia) * assistance.leftCols<3>();
  }
  if (scratch.derivative.wrong || !F.allFinite()) F.setZero();
  return F;
}

}  // namespace mimicx::control
