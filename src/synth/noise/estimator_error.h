/// What is known about the errors of video estimators joint by joint.
///
/// The noise model (noise.h) draws its errors with these weights. The keypoint fit does not know them.
#pragma once

namespace mimicx::synth {

/// w_j: how large the error of a body's rotation relative to its parent is beside that of a knee. The ends
/// of limbs are estimated worse than the trunk.                     docs/method.md, "Noise model"
/// @param body  index of the body; the root has weight 1
double relative_joint_error(int body);

}  // namespace mimicx::synth
