/// The joints of a body that no betas make.
#pragma once

#include "character/character.h"
#include "motion/clip.h"

namespace mimicx::test {

/// Every other bone is longer than the standard one, the others are shorter: left and right differ.
inline RestJoints uneven_joints() {
  const Character standard = make_character();
  RestJoints joints;
  joints[0] = rest_pelvis("smplx");
  for (int b = 1; b < kBodies; ++b)
    joints[b] = joints[kParents[b]] + (b % 2 == 1 ? 1.06 : 0.95) * standard.joint_offset[b];
  return joints;
}

/// The same motion on that body, as of a licensed model: the pelvis stays in its place.
inline motion::Clip on_uneven_joints(const motion::Clip& clip) {
  motion::Clip body;
  body.body_model = "smplx";
  body.rest_joints = uneven_joints();
  motion::Clip on_body = clip;
  motion::put_on_body_of(body, on_body);
  return on_body;
}

}  // namespace mimicx::test
