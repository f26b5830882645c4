/// Synthetic motions with known truth, for tests, the demo and the noise models.
///
/// A kind (walk, squat, …) is a plan: positions and times of the feet, the centre of pressure, the height of
/// the centre of mass, and the posture of trunk and arms, all as minimum-jerk tracks. One solver turns every
/// plan into a motion: the horizontal path of the centre of mass follows from the centre of pressure
/// (docs/method.md, "Synthetic motions"), the legs from inverse kinematics with planted feet. Knees and
/// elbows are exact hinges, and flight is ballistic. A new kind needs only a new plan (synth/kinds.h). Kinds
/// that go down to the floor, or onto seats, are sketches instead (synth/sketch.h).
///
/// Conventions: 30 frames per second, world z up, floor z = 0; `body_model` "mimicx". Stairs and seats are
/// plates of the clip's scene.
/// What it does not do: no torques (audit/feasibility.h computes them), no files (synth/data_set.h).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "motion/clip.h"

namespace mimicx::synth {

struct SynthConfig {
  std::string kind = "stand";          ///< of `synthetic_kinds()`, `floor_kinds()` or `ground_kinds()`
  std::uint64_t seed = 0;              ///< varies amplitudes, timing, heading and place
  std::array<double, kBetas> betas{};  ///< shape of the body
  bool betas_from_seed = false;        ///< add N(0, 0.7) per entry, within ±2, to `betas`
  double seconds = 0.0;                ///< length, 4 to 60 s; 0: the kind chooses 4 to 10 s
};

/// The exact kinds, in a fixed order. Their motions are physically possible.
std::vector<std::string> synthetic_kinds();
/// The sketched kinds, which go down to the floor. They are not physically possible before planning
/// (sketch.h).
std::vector<std::string> floor_kinds();
/// The kinds on stairs, kerbs, boxes, seats and beds. Steps are exact; seats and beds are sketches.
std::vector<std::string> ground_kinds();
/// The kinds of data/synthetic, and of sets that name no kinds.
std::vector<std::string> basic_kinds();

/// The key of a kind's random streams. @throws std::invalid_argument for an unknown kind
std::uint64_t index_of_kind(const std::string& name);

/// kind_seed.
std::string name_of(const SynthConfig& config);

/// The motion; equal settings give equal bytes. The clip's name is `name_of(config)`.
/// @throws std::invalid_argument for an unknown kind, a length outside 4 to 60 s, or a shape with |β_k| > 5.
motion::Clip synthesize(const SynthConfig& config);

}  // namespace mimicx::synth
