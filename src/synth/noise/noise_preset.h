/// Amplitudes of the noise model, with units, and its presets.     docs/method.md, "Noise model", (4) to (16)
///
/// What it does not do: no errors of the camera but `camera_turn` (hand_held_camera.h).
#pragma once

#include <span>
#include <string_view>

#include "character/character.h"

namespace mimicx::synth {

/// As it stands: no error.
struct NoisePreset {
  // Rotations.
  double joint_static = 0;  ///< °, constant error of a joint, about its parent's axes, Student's t, times v_j
  double joint_slow = 0;    ///< °, slow error, times v_j
  double joint_jitter = 0;     ///< °, from frame to frame, times v_j
  double jitter_frames = 0.8;  ///< frames over which joint_jitter is correlated
  double joint_shrink = 0;     ///< missing share of every joint's rotation: regression to the mean
  double root_static = 0;      ///< °, constant error of the root, about its own axes
  double wobble_turn = 0;      ///< °, rms of a slow oscillation of the root's orientation, world axes
  // Place of the root.
  double wobble = 0;         ///< m, rms of a slow oscillation of the root's place
  double depth = 0;          ///< relative error of the distance from the camera, in the first frame
  double stride = 0;         ///< relative error of the speed over the floor, wandering
  double drift = 0;          ///< m/s, false velocity in the person's own heading
  double turn_drift = 0;     ///< °/√s, walk of the heading; the path turns with it
  double height = 0;         ///< m, constant error of the height
  double snap = 0;           ///< removed share of the error of the lowest point's height
  double height_offset = 0;  ///< m, mean error of the height that is left
  double skate = 0;          ///< m/s, slip of a foot that stands, per axis
  // The body shape that is given to the program.
  double stature = 0;      ///< relative error
  double proportions = 0;  ///< error of every other entry of β
  // Keypoints. Box: larger side of the person's box in the picture.
  double time_offset = 0;        ///< frames by which the keypoints are late or early
  double offset_limb = 0;        ///< m per axis, constant in the frame of the keypoint's limb
  double offset_view = 0;        ///< m, turns with the direction from which the limb is seen
  double wander = 0;             ///< % of the box, slow
  double tail = 0;               ///< % of the box, frame by frame, scale of Student's t
  double foreshortening = 0;     ///< factor by which the two above grow for a limb that points at the camera
  double occlusion = 0;          ///< % of the box, for points that the body hides
  double swap_rate = 0;          ///< exchanges of left and right, per second
  double gap_rate = 0;           ///< frames without any detection: gaps per second
  double drop_share = 0;         ///< share of single detections that are missing
  double confidence_truth = 0;   ///< correlation of the confidence with the accuracy of a detection
  double confidence_spread = 0;  ///< standard deviation of the confidence
  // The camera that is given to the program.
  double camera_turn = 0;  ///< pan and roll errors, in σ of the tilt error
};

/// An amplitude by its name, for `--noise NAME=VALUE`.
struct Amplitude {
  const char* name;
  const char* unit;
  double NoisePreset::*value;
  double least = 0.0;  ///< smallest valid value
  double most = 1e6;   ///< largest valid value
};

/// All of them, in the order of the fields of `NoisePreset`.
std::span<const Amplitude> amplitudes();

/// "independent"; "gvhmr" and "vibe": the levels that the paper's Table 1 states for these estimators, as
/// docs/method.md, "Noise model" measures them; "none": exact motion and body. All share one detector.
/// @throws std::invalid_argument for another name, listing these
NoisePreset noise_preset(std::string_view name);

/// v_j: relative size of a joint's rotation error. The weights differ from those of the keypoint fit on
/// purpose.
double joint_error_weight(int body);

}  // namespace mimicx::synth
