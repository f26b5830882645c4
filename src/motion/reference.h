/// The motion that a simulated character follows, in the simulator's coordinates. prepare.h makes it of a
/// clip.
///
/// Generalised coordinates and velocities are those of physics/model.h: joint rotations relative to the
/// parent, joint angular velocities in the child's frame, root position and linear velocity of the pelvis
/// joint in the world, root angular velocity in the pelvis frame.
#pragma once

#include <optional>
#include <string>

#include "motion/clip.h"

namespace mimicx::motion {

struct ReferenceFrame {
  Vector3d p_root = Vector3d::Zero();  ///< pelvis joint in world, m
  Vector3d v_root = Vector3d::Zero();  ///< its velocity in world, m/s
  PerBody<Quaterniond> q;   ///< [0] root in world; joints relative to the parent, hinges about their axis
  PerBody<Vector3d> omega;  ///< [0] root; joints relative to the parent; in the body's own frame, rad/s
};

struct Reference {
  std::string name;
  double fps = 30.0;
  Character character;
  Scene scene;  ///< the ground under it
  PerFrame<ReferenceFrame> frames;
  PerFrame<BodyPoses> poses;           ///< forward kinematics of every frame
  PerFrame<bool> flagged;              ///< frames that were implausible and are interpolated
  std::optional<Keypoints> keypoints;  ///< at the reference's frames

  int size() const { return frames.count(); }
};

/// Fills in the velocities of `frames` by central differences on the rotation group, one-sided at both ends;
/// p_root and q must be set. A single frame keeps its velocities.
void differentiate(PerFrame<ReferenceFrame>& frames, double fps);

/// A clip of the reference's frames, or of those of a body that follows it, without keypoints. It has the
/// joints of the input's body, where the input tells them.
Clip clip_on_body_of(const Clip& input, const Reference& reference, const PerFrame<ReferenceFrame>& frames);

}  // namespace mimicx::motion
