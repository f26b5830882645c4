/// The points that 2D detectors find on a body, and the body's size in the picture.
///
/// What it does not do: no errors (keypoint_noise.h).
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

/// The points of a set, in its order. Points that are not joints lie on the skin of their body.
std::vector<Landmark> landmarks(motion::KeypointSet set);

/// Index of the point on the other side; the same index for a point without a side.
std::size_t mirror_of(const std::vector<Landmark>& points, std::size_t k);

bool is_descendant(int body, int ancestor);

/// Larger side of the box around the projected joints, px.
double box_size(const Camera& camera, const BodyPoses& poses);

}  // namespace mimicx::synth
