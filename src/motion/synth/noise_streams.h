/// What the files of the noise model share: the purposes of its random streams, intervals that begin at
/// random, and occlusions.
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "core/so3.h"

namespace mimicx::motion::synth {

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
  kDropStream
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

}  // namespace mimicx::motion::synth
