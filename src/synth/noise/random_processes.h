/// Random streams and random processes of the noise model: Poisson intervals, smooth noise, random walks.
#pragma once

#include <cstdint>
#include <vector>

#include "core/containers.h"
#include "core/random.h"
#include "core/so3.h"

namespace mimicx::synth {

enum NoiseStream : std::uint64_t {
  kToldCameraStream = 0x4E4F490A,
  kCameraStream,
  kCarriedCameraStream = 0x4E4F4910,
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

struct Interval {
  int first, length;  ///< frames
};

/// A Poisson process of `rate` beginnings per second; lengths uniform in [shortest, longest], cut at the end.
std::vector<Interval> poisson_intervals(Random& random, double rate, double shortest, double longest,
                                        int frames, double fps);

/// J_s, and S_τ with frames = τ · fps: unit variance, correlated over `frames`. @param random  advanced
PerFrame<double> smooth_noise(Random& random, int count, double frames);

/// size·J_s or size·S_τ; draws nothing where `size` is 0. @param random  advanced
PerFrame<double> smooth_error(Random& random, int count, double size, double frames);

/// Three independent ones, for the axes of a vector. @param random  advanced
PerFrame<Vector3d> smooth_errors(Random& random, int count, double size, double frames);

/// Student's t with a whole number of degrees of freedom. @param random  advanced
double student_t(Random& random, int freedom);

/// A random walk that starts at 0 and whose variance grows by 1 per second after τ. Its velocity is the
/// smooth process S_τ / √(2√π τ), so its position is smooth as well. @param random  advanced
PerFrame<double> smooth_walk(Random& random, int count, double tau, double fps);

}  // namespace mimicx::synth
