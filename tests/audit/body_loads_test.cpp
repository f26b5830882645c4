#include "audit/body_loads.h"

#include <gtest/gtest.h>

namespace mimicx::audit {
namespace {

TEST(TorqueShares, AreTorqueOverBoundAndAboutTheAxisForHinges) {
  const Character c = make_character();
  PerBody<Vector3d> torque;
  torque.fill(Vector3d::Zero());
  torque[kPelvis] = Vector3d(100.0, 0.0, 0.0);  // has no joint
  torque[kLeftHip] = c.joint[kLeftHip].torque_limit * Vector3d(0.6, 0.0, -0.8);
  const Vector3d axis = hinge_axis(kRightKnee), beside = axis.unitOrthogonal();
  torque[kRightKnee] = c.joint[kRightKnee].torque_limit * (-0.25 * axis + 3.0 * beside);
  const PerBody<double> shares = torque_shares(c, torque);
  for (int b = 0; b < kBodies; ++b)
    EXPECT_NEAR(shares[b], b == kLeftHip ? 1.0 : b == kRightKnee ? 0.25 : 0.0, 1e-12) << b;
}

}  // namespace
}  // namespace mimicx::audit
