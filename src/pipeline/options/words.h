/// Clusters of motions in words a person understands, from their features alone.
///
/// Rules are deterministic. The thresholds are about what an onlooker calls slow, low or busy; what a feature
/// cannot tell (in which order things happen, whether a foot is planted) is not said.
#pragma once

#include <string>
#include <vector>

#include "pipeline/options/clusters.h"

namespace mimicx {

/// `describe_motion` of one centre, and in what it stands out among the others.
std::string describe_cluster(const std::vector<MotionFeatures>& centres, int cluster);

}  // namespace mimicx
