#include "rl/tracking/tracking_clip.h"

#include <cmath>
#include <stdexcept>

#include "physics/lanes.h"

namespace mimicx::rl::tracking {

void require_whole_steps(double physics_rate, double fps) {
  const double substeps = physics_rate / fps;
  if (!(substeps >= 1.0) || std::abs(substeps - std::round(substeps)) > 1e-9)
    throw std::invalid_argument(
        "physics_rate: the physics rate must be a multiple of the reference's frame rate");
}

std::shared_ptr<const TrackingClip> make_tracking_clip(const motion::Reference& reference,
                                                       const TrackingConfig& config) {
  if (reference.size() < 2) throw std::invalid_argument("a reference needs at least 2 frames");
  require_whole_steps(config.simulation.rate, reference.fps);
  auto clip = std::make_shared<TrackingClip>();
  clip->reference = reference;
  clip->model = physics::make_model<float>(reference.character, config.simulation, reference.scene);
  for (std::size_t t = 0; t < reference.frames.size(); ++t)
    clip->poses.push_back({reference.frames[t], reference.poses[t].p_WB,
                           reference.scene.height_under(reference.frames[t].p_root)});
  Pose rest = clip->poses.back();
  rest.frame.v_root.setZero();
  for (auto& omega : rest.frame.omega) omega.setZero();
  clip->poses.push_back(rest);
  for (const Pose& pose : clip->poses) clip->joints.push_back(joint_features(pose.frame));
  if (reference.keypoints) clip->keypoints = match_keypoints(*reference.keypoints);
  return clip;
}

physics::State<double> simulator_state(const motion::ReferenceFrame& frame) {
  physics::State<double> x;
  x.p_root = physics::from_eigen(frame.p_root);
  x.v_root = physics::from_eigen(frame.v_root);
  for (int i = 0; i < kBodies; ++i) {
    x.q[i] = physics::from_eigen(frame.q[i]);
    x.omega[i] = physics::from_eigen(frame.omega[i]);
  }
  return x;
}

List<physics::State<double>> simulator_states(const motion::Reference& reference) {
  List<physics::State<double>> states;
  for (const motion::ReferenceFrame& frame : reference.frames) states.push_back(simulator_state(frame));
  return states;
}

motion::ReferenceFrame frame_of_state(const physics::State<double>& x) {
  motion::ReferenceFrame frame;
  frame.p_root = physics::to_eigen(x.p_root);
  frame.v_root = physics::to_eigen(x.v_root);
  for (int i = 0; i < kBodies; ++i) {
    frame.q[i] = physics::to_eigen(x.q[i]);
    frame.omega[i] = physics::to_eigen(x.omega[i]);
  }
  return frame;
}

motion::Reference reference_of_states(const motion::Reference& of,
                                      const List<physics::State<double>>& states) {
  motion::Reference out;
  out.name = of.name;
  out.fps = of.fps;
  out.character = of.character;
  out.scene = of.scene;
  for (const physics::State<double>& x : states) {
    motion::ReferenceFrame& frame = out.frames.emplace_back(frame_of_state(x));
    for (Quaterniond& q : frame.q) q = q.normalized();
    out.poses.push_back(forward_kinematics(out.character, frame.p_root, frame.q));
    out.flagged.push_back(false);
  }
  return out;
}

}  // namespace mimicx::rl::tracking
