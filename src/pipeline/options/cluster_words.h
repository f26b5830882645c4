/// Motions and clusters of motions in words a person understands, from their features alone.
///
/// Rules are deterministic. The thresholds are about what an onlooker calls slow, low or busy. Features do
/// not tell in which order things happen or whether a foot is planted: the words do not say it.
#pragma once

#include <string>

#include "core/containers.h"
#include "pipeline/options/features.h"

namespace mimicx::pipeline::options {

/// What a motion of these features is like: how it travels, turns, how high it is, what arms and legs do, how
/// vigorous it is. The thresholds are absolute: no other motion matters.
std::string describe_motion(const MotionFeatures& features);

/// `describe_motion` of one centre, and in what it exceeds all others by a fifth.
/// @param centres  of all clusters @param cluster  which of them to describe
std::string describe_cluster(const List<MotionFeatures>& centres, int cluster);

}  // namespace mimicx::pipeline::options
