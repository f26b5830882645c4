/// Synthetic motions of known truth: what tests, the demo and the noise model start from.
///
/// A kind (walk, squat, …) is a plan: where the feet stand and when, where the centre of pressure goes, how
/// high the centre of mass is and how trunk and arms are held, all as minimum-jerk tracks. One solver turns
/// every plan into motion: the horizontal path of the centre of mass follows from the centre of pressure
/// (docs/method.md, "Synthetic motions"), the legs from inverse kinematics with planted feet. Knees and
/// elbows are exact hinges, flight is ballistic. A new kind is a new plan (synth/kinds.h), nothing
/// else. Kinds that go down to the floor are sketches instead (synth/sketch.h).
///
/// Conventions: 30 frames per second, world z up, floor z = 0; `body_model` "mimicx".
/// What it does not do: no torques (audit/feasibility.h asks for them), no files
/// (synth/data_set.h), no floor but the flat one.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "motion/clip.h"

namespace mimicx::synth {

struct SynthConfig {
  std::string kind = "stand";          ///< of `synthetic_kinds()` or `floor_kinds()`
  std::uint64_t seed = 0;              ///< varies amplitudes, timing, heading and place
  std::array<double, kBetas> betas{};  ///< shape of the body
  bool betas_from_seed = false;        ///< add N(0, 0.7) per entry, within ±2, to `betas`
  double seconds = 0.0;                ///< length; 0 lets the kind choose (4 to 10 s); otherwise 4 to 60 s
};

/// The exact kinds, in a fixed order: their motions are what a body can do.
std::vector<std::string> synthetic_kinds();
/// The sketched kinds, which go down to the floor: no forces explain them before they are planned (sketch.h).
std::vector<std::string> floor_kinds();
/// Those of the set in the repository, data/synthetic, and of sets that name no kinds.
std::vector<std::string> basic_kinds();

/// What tells the random streams of kinds apart. @throws std::invalid_argument for an unknown kind
std::uint64_t index_of_kind(const std::string& name);

/// kind_seed.
std::string name_of(const SynthConfig& config);

/// The exact motion; the same settings give the same bytes. The clip has the name above.
/// @throws std::invalid_argument for an unknown kind, a length outside 4 to 60 s, or a shape with |β_k| > 5.
motion::Clip synthesize(const SynthConfig& config);

}  // namespace mimicx::synth
