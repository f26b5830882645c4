/// The points that 2D detectors find on a body, and how large the body is in the picture.
///
/// What it does not do: no errors (keypoint_noise.h, independent_keypoints.h).
#pragma once

#include <string>
#include <vector>

#include "motion/keypoint_names.h"
#include "synth/noise/hand_held_camera.h"

namespace mimicx::synth {

/// A detected point: fixed to a body.
struct Landmark {
  std::string name;
  int body;
  Vector3d p_B;
};

/// In the order of the set; what is no joint has a place on the skin of its body.
std::vector<Landmark> landmarks(motion::KeypointSet set);

/// The other side's keypoint of the same limb, or the same index for one in the middle.
std::size_t mirror_of(const std::vector<Landmark>& points, std::size_t k);

bool is_descendant(int body, int ancestor);

/// Larger side of the box around the projected joints, px.
double box_size(const Camera& camera, const BodyPoses& poses);

}  // namespace mimicx::synth
