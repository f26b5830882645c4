#include "synth/noise/noise_amplitudes.h"

namespace mimicx::synth {
namespace {

constexpr double kShortest = 0.01;  ///< of a time constant, frames
constexpr double kLowest = -10.0;   ///< of the height, m

constexpr Amplitude kAmplitudes[] = {
    {"joint_static", "deg", &NoisePreset::joint_static},
    {"joint_slow", "deg", &NoisePreset::joint_slow},
    {"joint_jitter", "deg", &NoisePreset::joint_jitter},
    {"jitter_frames", "frames", &NoisePreset::jitter_frames, kShortest, 1e3},
    {"joint_shrink", "ratio", &NoisePreset::joint_shrink, 0.0, 1.0},
    {"root_static", "deg", &NoisePreset::root_static},
    {"wobble_turn", "deg", &NoisePreset::wobble_turn},
    {"wobble", "m", &NoisePreset::wobble},
    {"depth", "ratio", &NoisePreset::depth},
    {"stride", "ratio", &NoisePreset::stride},
    {"drift", "m/s", &NoisePreset::drift},
    {"turn_drift", "deg/sqrt(s)", &NoisePreset::turn_drift},
    {"height", "m", &NoisePreset::height},
    {"snap", "ratio", &NoisePreset::snap, 0.0, 1.0},
    {"height_offset", "m", &NoisePreset::height_offset, kLowest, 10.0},
    {"skate", "m/s", &NoisePreset::skate},
    {"stature", "ratio", &NoisePreset::stature},
    {"proportions", "beta", &NoisePreset::proportions},
    {"time_offset", "frames", &NoisePreset::time_offset},
    {"offset_limb", "m", &NoisePreset::offset_limb},
    {"offset_view", "m", &NoisePreset::offset_view},
    {"wander", "% box", &NoisePreset::wander},
    {"tail", "% box", &NoisePreset::tail},
    {"foreshortening", "ratio", &NoisePreset::foreshortening},
    {"occlusion", "% box", &NoisePreset::occlusion},
    {"swap_rate", "1/s", &NoisePreset::swap_rate, 0.0, 100.0},
    {"gap_rate", "1/s", &NoisePreset::gap_rate, 0.0, 100.0},
    {"drop_share", "ratio", &NoisePreset::drop_share, 0.0, 1.0},
    {"confidence_truth", "correlation", &NoisePreset::confidence_truth, 0.0, 1.0},
    {"confidence_spread", "1", &NoisePreset::confidence_spread},
    {"camera_turn", "ratio", &NoisePreset::camera_turn},
};

// A field that no row names could not be set: the struct is nothing but doubles.
static_assert(sizeof(NoisePreset) == std::size(kAmplitudes) * sizeof(double));

}  // namespace

std::span<const Amplitude> amplitudes() { return kAmplitudes; }

}  // namespace mimicx::synth
