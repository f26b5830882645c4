/// The amplitudes of both noise models by name, for `--noise NAME=VALUE` and for tables.
#pragma once

#include <span>
#include <string_view>

#include "synth/noise/estimator_noise.h"
#include "synth/noise/independent_preset.h"

namespace mimicx::synth {

template <class Preset>
struct Amplitude {
  const char* name;
  const char* unit;
  double Preset::*value;
  double least = 0.0;  ///< smallest valid value
  double most = 1e6;   ///< largest valid value
};

/// All of a preset, in the order of its fields.
std::span<const Amplitude<NoisePreset>> amplitudes(const NoisePreset&);
std::span<const Amplitude<IndependentPreset>> amplitudes(const IndependentPreset&);

}  // namespace mimicx::synth
