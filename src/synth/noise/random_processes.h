/// What the files of the noise model share: the purposes of its random streams, intervals that begin at
/// random, and occlusions.
#pragma once

#include <cstdint>
#include <vector>

#include "core/containers.h"
#include "core/random.h"
#include "core/so3.h"

namespace mimicx::synth {

enum NoiseStream : std::uint64_t {
  kJointStream = 0x4E4F4901,
  kRootStream,
  kHeadingStream,
  kPathStream,
  kDepthStream,
  kDriftStream,
  kHeightStream,
  kBurstStream,
  kToldShapeStream,
  kToldCameraStream,
  kCameraStream,
  kKeypointBiasStream,
  kKeypointStream,
  kSwapStream,
  kDropStream,
  kCarriedCameraStream,
  kHandStream,
  kToldDriftStream,
  kToldTurnStream,
  kJointConstantStream,
  kJointSlowStream,
  kJointJitterStream,
  kRootConstantStream,
  kWobbleTurnStream,
  kWobbleStream,
  kDistanceStream,
  kFloorStream,
  kStrideStream,
  kFalseVelocityStream,
  kHeadingWalkStream,
  kSkateStream,
  kStatureStream,
  kProportionStream,
  kTimeOffsetStream,
  kLimbOffsetStream,
  kViewOffsetStream,
  kWanderStream,
  kTailStream,
  kHiddenStream,
  kMixUpStream,
  kGapStream,
  kMissStream,
  kConfidenceStream,
  kClipSeedStream
};

inline constexpr double kHeightTau = 1.5;  ///< of the slow term of the height, s

/// Occlusion of one limb joint: a Hann window of rotation error, low confidence for its keypoints.
struct Burst {
  int joint;
  int first, length;  ///< frames
  Vector3d peak;      ///< rotation vector at the window's middle, rad
};

struct Interval {
  int first, length;  ///< frames
};

/// A Poisson process of `rate` beginnings per second; lengths uniform in [shortest, longest], cut at the end.
std::vector<Interval> poisson_intervals(Random& random, double rate, double shortest, double longest,
                                        int frames, double fps);

/// J_s, and S_τ with frames = τ · fps: unit variance, correlated over `frames`. @param random  advanced
PerFrame<double> smooth_noise(Random& random, int count, double frames);

/// Student's t with a whole number of degrees of freedom. @param random  advanced
double student_t(Random& random, int freedom);

/// A walk that begins at 0 and whose variance grows, after τ, by 1 per second. Its velocity is the smooth
/// process S_τ / √(2√π τ), so that its position is smooth, too. @param random  advanced
PerFrame<double> smooth_walk(Random& random, int count, double tau, double fps);

}  // namespace mimicx::synth
