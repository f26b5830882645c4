#include "control/shooting.h"

#include <algorithm>
#include <memory>

namespace mimicx::control {

List<Eigen::VectorXd> find_gaps(const System& system, const Trajectory& trajectory) {
  const int n = trajectory.size();
  List<Eigen::VectorXd> gaps(n + 1, Eigen::VectorXd::Zero(kTangent));
  const auto scratch = std::make_unique<Data<P>>();
  State<P> x, expected;
  Target<P> from{}, to{};
  Wrench<P> assistance = assistance_of(system, Control{});
  for (int first = 0; first < n; first += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const int t = std::min(first + lane, n - 1), frame = trajectory.begin + t;
      const auto entries = [](const Control& u, int offset) {
        return [&u, offset](int i) { return u[offset + i]; };
      };
      set_lane(x, lane, trajectory.x[t]);
      set_lane(expected, lane, trajectory.x[t + 1]);
      set_target(system, frame, entries(trajectory.previous(t), 0), lane, from);
      set_target(system, frame + 1, entries(trajectory.u[t], 0), lane, to);
      if (system.assisted) set_assistance(system, entries(trajectory.u[t], kDofs), lane, assistance);
    }
    advance(system, from, to, assistance, x, *scratch);
    const Tangent<P> d = difference(x, expected);
    for (int lane = 0; lane < std::min(kLanes, n - first); ++lane) {
      Eigen::VectorXd& gap = gaps[first + lane + 1];
      for (int k = 0; k < kTangent; ++k) gap[k] = static_cast<double>(d[k][lane]);
      // ⊖ of equal states is the rounding of a quaternion product.
      if (!gap.allFinite() || gap.cwiseAbs().maxCoeff() < 1e-6) gap.setZero();
    }
  }
  return gaps;
}

}  // namespace mimicx::control
