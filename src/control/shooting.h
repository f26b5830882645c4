/// Multiple shooting: trajectories whose states may have gaps between frames.
///
/// A roll-out of a poor guess falls, and derivatives along a fall are useless for standing. Therefore frames
/// that have no plan yet start at the reference's own states, with gaps between them,
///     gap_{t+1} = f_t(x_t, u_{t−1}, u_t) ⊖ x_{t+1}                            (docs/control.md §3, (5)).
/// The sweep includes the gaps, and the roll-out under its laws closes all of them at once.
/// Source: Giftthaler et al., "A Family of Iterative Gauss–Newton Shooting Methods" (2018); Mastalli et al.,
/// "Crocoddyl" (2020), §IV. Deviation: they keep a share 1 − α of the gaps at shorter steps; here every step
/// length is simulated without gaps, and the best one is taken.
#pragma once

#include "control/trajectory.h"

namespace mimicx::control {

/// [n + 1] gaps of a trajectory's states; [0] is zero. Frames are simulated in the lanes of packs; a failed
/// frame has a gap of zero.
List<Eigen::VectorXd> find_gaps(const System& system, const Trajectory& trajectory);

}  // namespace mimicx::control
