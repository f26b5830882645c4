#include "synth/noise/noise_preset.h"

#include <stdexcept>
#include <string>

namespace mimicx::synth {

namespace {

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
