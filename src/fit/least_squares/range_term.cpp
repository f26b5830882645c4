#include "fit/least_squares/range_term.h"

#include "character/joint_range.h"
#include "core/elementary.h"
#include "core/units.h"

namespace mimicx::fit {

void add_ranges(const FitProblem& problem, const FrameKinematics& k, int t, BorderedBand& system) {
  const double weight = 1.0 / square(kDegree * problem.config.range_sigma);
  for (int b = 1; b < kBodies; ++b) {
    const Quaterniond q = k.poses.q_WB[kParents[b]].conjugate() * k.poses.q_WB[b];
    const RangeDistance range = range_distance(problem.joint[b], b, q);
    if (range.excess <= 0.0) continue;
    // The joint's correction turns it by M in the world; of a hinge this is one column.
    const int at = kFirstJoint + first_dof(b), count = is_hinge(b) ? 1 : 3;
    const Eigen::VectorXd J = (k.M[b].transpose() * (k.R[b] * range.slope)).head(count);
    system.diagonal[t].block(at, at, count, count).noalias() += weight * J * J.transpose();
    system.rhs[t].segment(at, count) -= weight * range.excess * J;
  }
}

}  // namespace mimicx::fit
