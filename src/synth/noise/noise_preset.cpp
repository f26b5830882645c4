#include "synth/noise/noise_preset.h"

#include <stdexcept>
#include <string>

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

/// Exact motion and body; the detector and the camera's turn of every preset.
NoisePreset detector() {
  NoisePreset p;
  p.time_offset = 0.5, p.offset_limb = 0.007, p.offset_view = 0.006;
  p.wander = 0.25, p.tail = 0.15, p.foreshortening = 2.0, p.occlusion = 1.0;
  p.swap_rate = 0.06, p.gap_rate = 0.08, p.drop_share = 0.015;
  p.confidence_truth = 0.3, p.confidence_spread = 0.12;
  p.camera_turn = 0.7;
  return p;
}

NoisePreset independent() {
  NoisePreset p = detector();
  p.joint_static = 3.7, p.joint_slow = 2.5, p.joint_jitter = 0.22, p.joint_shrink = 0.04;
  p.root_static = 2.0, p.wobble_turn = 0.3;
  p.wobble = 0.004, p.depth = 0.075, p.stride = 0.025, p.drift = 0.015, p.turn_drift = 0.5;
  p.height = 0.05, p.skate = 0.03;
  p.stature = 0.03, p.proportions = 0.4;
  return p;
}

/// Smooth and floating.
NoisePreset gvhmr() {
  NoisePreset p = independent();
  p.joint_static = 4.1, p.joint_jitter = 0.265, p.root_static = 1.5;
  p.depth = 0.069, p.height = 0.075, p.height_offset = 0.072, p.skate = 0.01;
  return p;
}

/// Frame by frame: it trembles and slides, but stays near the floor.
NoisePreset vibe() {
  NoisePreset p = independent();
  p.joint_static = 5.3, p.joint_slow = 4.0, p.joint_jitter = 0.77, p.jitter_frames = 0.55;
  p.root_static = 0.7, p.depth = 0.034, p.height = 0.0, p.skate = 0.01;
  p.snap = 0.9, p.height_offset = -0.008;
  return p;
}

}  // namespace

std::span<const Amplitude> amplitudes() { return kAmplitudes; }

NoisePreset noise_preset(std::string_view name) {
  if (name == "independent") return independent();
  if (name == "gvhmr") return gvhmr();
  if (name == "vibe") return vibe();
  if (name == "none") return detector();
  throw std::invalid_argument("unknown noise '" + std::string(name) +
                              "'; known: independent, gvhmr, vibe, none, or NAME=VALUE");
}

double joint_error_weight(int body) {
  switch (body) {
    case kLeftHip:
    case kRightHip:
      return 0.6;
    case kLeftKnee:
    case kRightKnee:
    case kSpine1:
    case kSpine2:
    case kSpine3:
      return 0.8;
    case kLeftAnkle:
    case kRightAnkle:
      return 0.7;
    case kLeftFoot:
    case kRightFoot:
      return 0.3;
    case kLeftCollar:
    case kRightCollar:
      return 0.9;
    case kNeck:
    case kLeftElbow:
    case kRightElbow:
      return 1.1;
    case kHead:
      return 1.3;
    case kLeftWrist:
    case kRightWrist:
      return 1.9;
    default:
      return 1.0;
  }
}

}  // namespace mimicx::synth
