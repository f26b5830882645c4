/// What a character sees and does, seen in a mirror: left is right.
///
/// The bodies are symmetric (x → −x of the body frame swaps left and right, character/standard_body.h), and
/// so is the simulation. Whoever sees the mirror image of a state s and does the mirror image of an action a
/// therefore ends in the mirror image of where a leads to from s: every lesson is two.
/// In the heading frame of the state the mirror is y → −y. Positions and velocities are reflected; rotation
/// vectors and angular velocities keep the component along the mirror's normal and turn the others about.
#pragma once

#include "core/containers.h"

namespace mimicx::rl::tracking {

/// Entry k of the image is sign[k] times entry from[k].
struct MirrorMap {
  List<int> from;
  List<float> sign;

  int size() const { return from.count(); }
};

/// Of the state without an encoder (state.h): [570]. A code of an encoder has no mirror image.
MirrorMap mirror_of_state();
/// Of an action, rotation vectors or angles of the joints: [55].
MirrorMap mirror_of_action();

/// @param in, out  [map.size()]; not the same
void reflect(const MirrorMap& map, const float* in, float* out);

}  // namespace mimicx::rl::tracking
