#include "synth/noise/noise_amplitudes.h"

namespace mimicx::synth {
namespace {

constexpr double kShortest = 0.01;  ///< of a time constant, s or frames
constexpr double kLowest = -10.0;   ///< of the height, m

constexpr Amplitude<NoisePreset> kFitted[] = {
    {"joint_static", "deg", &NoisePreset::joint_static},
    {"joint_slow", "deg", &NoisePreset::joint_slow},
    {"slow_tau", "s", &NoisePreset::slow_tau, kShortest, 1e3},
    {"joint_jitter", "deg", &NoisePreset::joint_jitter},
    {"jitter_frames", "frames", &NoisePreset::jitter_frames, kShortest, 1e3},
    {"root_static", "deg", &NoisePreset::root_static},
    {"root_slow", "deg", &NoisePreset::root_slow},
    {"root_jitter", "deg", &NoisePreset::root_jitter},
    {"heading_walk", "deg/sqrt(s)", &NoisePreset::heading_walk},
    {"burst_rate", "1/s", &NoisePreset::burst_rate, 0.0, 100.0},
    {"burst_frames_min", "frames", &NoisePreset::burst_frames_min, 1.0, 1e4},
    {"burst_frames_max", "frames", &NoisePreset::burst_frames_max, 1.0, 1e4},
    {"burst_min", "deg", &NoisePreset::burst_min},
    {"burst_max", "deg", &NoisePreset::burst_max},
    {"depth_static", "m", &NoisePreset::depth_static},
    {"depth_slow", "m", &NoisePreset::depth_slow},
    {"depth_tau", "s", &NoisePreset::depth_tau, kShortest, 1e3},
    {"depth_jitter", "m", &NoisePreset::depth_jitter},
    {"depth_jitter_frames", "frames", &NoisePreset::depth_jitter_frames, kShortest, 1e3},
    {"lateral", "ratio", &NoisePreset::lateral},
    {"drift", "m/s", &NoisePreset::drift},
    {"drift_tau", "s", &NoisePreset::drift_tau, kShortest, 1e3},
    {"speed_error", "ratio", &NoisePreset::speed_error},
    {"heading_error", "deg", &NoisePreset::heading_error},
    {"snap", "ratio", &NoisePreset::snap, 0.0, 1.0},
    {"snap_frames", "frames", &NoisePreset::snap_frames, 0.0, 1e3},
    {"height_offset", "m", &NoisePreset::height_offset, kLowest},
    {"height_static", "m", &NoisePreset::height_static},
    {"height_slow", "m", &NoisePreset::height_slow},
    {"height_jitter", "m", &NoisePreset::height_jitter},
};

constexpr Amplitude<IndependentPreset> kIndependent[] = {
    {"joint_static", "deg", &IndependentPreset::joint_static},
    {"joint_slow", "deg", &IndependentPreset::joint_slow},
    {"joint_jitter", "deg", &IndependentPreset::joint_jitter},
    {"joint_shrink", "ratio", &IndependentPreset::joint_shrink, 0.0, 1.0},
    {"root_static", "deg", &IndependentPreset::root_static},
    {"wobble_turn", "deg", &IndependentPreset::wobble_turn},
    {"wobble", "m", &IndependentPreset::wobble},
    {"depth", "ratio", &IndependentPreset::depth},
    {"stride", "ratio", &IndependentPreset::stride},
    {"drift", "m/s", &IndependentPreset::drift},
    {"turn_drift", "deg/sqrt(s)", &IndependentPreset::turn_drift},
    {"height", "m", &IndependentPreset::height},
    {"skate", "m/s", &IndependentPreset::skate},
    {"stature", "ratio", &IndependentPreset::stature},
    {"proportions", "beta", &IndependentPreset::proportions},
    {"time_offset", "frames", &IndependentPreset::time_offset},
    {"offset_limb", "m", &IndependentPreset::offset_limb},
    {"offset_view", "m", &IndependentPreset::offset_view},
    {"wander", "% box", &IndependentPreset::wander},
    {"tail", "% box", &IndependentPreset::tail},
    {"foreshortening", "ratio", &IndependentPreset::foreshortening},
    {"occlusion", "% box", &IndependentPreset::occlusion},
    {"swap_rate", "1/s", &IndependentPreset::swap_rate, 0.0, 100.0},
    {"gap_rate", "1/s", &IndependentPreset::gap_rate, 0.0, 100.0},
    {"drop_share", "ratio", &IndependentPreset::drop_share, 0.0, 1.0},
    {"confidence_truth", "correlation", &IndependentPreset::confidence_truth, 0.0, 1.0},
    {"confidence_spread", "1", &IndependentPreset::confidence_spread},
    {"camera_turn", "ratio", &IndependentPreset::camera_turn},
};

// A field that no row names could not be set: both structs are nothing but doubles.
static_assert(sizeof(NoisePreset) == std::size(kFitted) * sizeof(double));
static_assert(sizeof(IndependentPreset) == std::size(kIndependent) * sizeof(double));

}  // namespace

std::span<const Amplitude<NoisePreset>> amplitudes(const NoisePreset&) { return kFitted; }
std::span<const Amplitude<IndependentPreset>> amplitudes(const IndependentPreset&) { return kIndependent; }

}  // namespace mimicx::synth
