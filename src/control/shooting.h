/// Multiple shooting: a trajectory whose frames need not fit together yet.
///
/// A roll-out of a poor guess falls, and derivatives along a fall say nothing about standing. So the frames
/// of which nothing is known yet start at the reference's own states, with gaps in between,
///     gap_{t+1} = f_t(x_t, u_{t−1}, u_t) ⊖ x_{t+1}                            (docs/control.md §3, (5)),
/// the sweep takes the gaps into account, and the roll-out under its laws closes them all at once.
/// Source: Giftthaler et al., "A Family of Iterative Gauss–Newton Shooting Methods" (2018); Mastalli et al.,
/// "Crocoddyl" (2020), §IV. Deviation: they keep a share 1 − α of the gaps at shorter steps; here every step
/// is simulated without gaps, and the best one is taken.
#pragma once

#include "control/trajectory.h"

namespace mimicx::control {

/// [n + 1]: gaps of a trajectory's states; [0] is zero. Frames go through the simulator in the lanes of
/// packs. A frame that goes wrong there has a gap of zero.
List<Eigen::VectorXd> find_gaps(const System& system, const Trajectory& trajectory);

}  // namespace mimicx::control
