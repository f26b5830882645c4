#include "audit/torque_shares.h"

#include <cmath>

namespace mimicx::audit {

PerBody<double> torque_shares(const Character& c, const PerBody<Vector3d>& torque) {
  PerBody<double> shares{};
  for (int b = 1; b < kBodies; ++b)
    shares[b] =
        (is_hinge(b) ? std::abs(torque[b].dot(hinge_axis(b))) : torque[b].norm()) / c.joint[b].torque_limit;
  return shares;
}

}  // namespace mimicx::audit
