/// The amplitudes of the noise model by name, for `--noise NAME=VALUE` and for tables.
#pragma once

#include <span>

#include "synth/noise/noise_preset.h"

namespace mimicx::synth {

struct Amplitude {
  const char* name;
  const char* unit;
  double NoisePreset::*value;
  double least = 0.0;  ///< smallest valid value
  double most = 1e6;   ///< largest valid value
};

/// All of them, in the order of the fields of `NoisePreset`.
std::span<const Amplitude> amplitudes();

}  // namespace mimicx::synth
