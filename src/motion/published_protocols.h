/// Published evaluation protocols, for tables that can be compared with the papers'.         docs/metrics.md
///
///  - phc   physics-based imitation: Z. Luo et al., "Perpetual Humanoid Control for Real-time Simulated
///          Avatars" (ICCV 2023), evaluation of its repository and of SMPLSim
///  - pmr   plausibility of what was recovered from video: Y. Zhang et al., "A Plug-and-Play Physical Motion
///          Restoration Approach …" (arXiv 2412.17377), columns after Y. Yuan et al., "PhysDiff" (ICCV 2023)
///  - emdb  recovery in the world: the second split of EMDB (M. Kaufmann et al., ICCV 2023) as the
///          evaluations of WHAM (S. Shin et al., CVPR 2024) and GVHMR (Z. Shen et al., 2024) have it
///
/// A value is the mean of its samples. The mean of a table pools the samples of all motions, so that long
/// motions count more, as in those evaluations. All three protocols are defined at 30 frames per second.
///
/// Differences from the published evaluations: 22 joints instead of SMPL's 24 (no hands), surface points of
/// our collision shapes instead of mesh vertices.
#pragma once

#include <string>
#include <vector>

#include "motion/metrics.h"

namespace mimicx::motion {

enum class Protocol { kPhc, kPmr, kEmdb };

inline constexpr double kProtocolRate = 30.0;  ///< frames per second

struct ProtocolColumn {
  const char* name;
  const char* unit;
  const char* definition;
  const char* source;  ///< code or paper that defines it
};

/// "phc", "pmr", "emdb".
const std::vector<std::string>& protocol_names();
/// The columns in the order of the table.
const std::vector<ProtocolColumn>& protocol_columns(Protocol protocol);

/// A value per column; NaN with a count of 0 where it is undefined.
/// @throws std::invalid_argument when truth and motion differ in length, are not at 30 fps or lack feet
std::vector<MetricValue> evaluate_by(Protocol protocol, const MotionSamples& motion,
                                     const MotionSamples& truth);

/// Mean over the samples of several motions.
MetricValue pooled(const std::vector<MetricValue>& values);

}  // namespace mimicx::motion
