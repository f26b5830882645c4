/// Descriptions of motions and clusters in words, from their features alone.
///
/// The rules are deterministic; the thresholds are about what an onlooker calls slow, low or busy. Features
/// do not tell the order of events or whether a foot is planted, so neither do the words.
#pragma once

#include <string>

#include "core/containers.h"
#include "pipeline/options/features.h"

namespace mimicx::pipeline::options {

/// Describes a motion with these features: how it travels and turns, how high it is, what arms and legs do,
/// how vigorous it is. Thresholds are absolute, independent of other motions.
std::string describe_motion(const MotionFeatures& features);

/// `describe_motion` of one centre, and the qualities in which it exceeds all others by a fifth.
/// @param centres  of all clusters @param cluster  which of them to describe
std::string describe_cluster(const List<MotionFeatures>& centres, int cluster);

}  // namespace mimicx::pipeline::options
