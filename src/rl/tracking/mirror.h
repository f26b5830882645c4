/// Mirror images of states and actions: left and right are swapped.
///
/// The bodies are symmetric (x → −x of the body frame swaps left and right, character/standard_body.h), and
/// so is the simulation. Hence, if action a leads from state s to s', the mirror image of a leads from the
/// mirror image of s to that of s': every training sample gives two. In the heading frame of the state the
/// mirror is y → −y. Positions and velocities are reflected; rotation vectors and angular velocities keep the
/// component along the mirror's normal and negate the others.
#pragma once

#include "core/containers.h"

namespace mimicx::rl::tracking {

/// Entry k of the image is sign[k] times entry from[k].
struct MirrorMap {
  List<int> from;
  List<float> sign;

  int size() const { return from.count(); }
};

/// Map of the state without an encoder (state.h): [570]. A code of an encoder has no mirror image.
MirrorMap mirror_of_state();
/// Map of an action, rotation vectors or angles of the joints: [55].
MirrorMap mirror_of_action();

/// Writes the mirror image of `in`. @param in, out  [map.size()]; must not overlap
void reflect(const MirrorMap& map, const float* in, float* out);

}  // namespace mimicx::rl::tracking
