/// Violent meetings with the floor, and what the contact law does wrong in them: shared by the tests, which
/// bound it, and by tools/bench_contact, which prints it.
///
/// A scene runs for three seconds in every lane of a training pack, self contact on, PD target the pose of
/// the start. Impulses are summed over all points, lanes and steps.
#pragma once

#include "physics/test_states.h"

namespace mimicx::physics {

enum class Scene { kStand, kFall, kDrop, kThrow };  ///< at rest; pushed over; from 1 m; 3 m/s and 3 rad/s
inline constexpr const char* kSceneNames[] = {"stand", "fall", "drop", "throw"};

/// What happened in a scene.
struct SceneReport {
  bool wrong = false;       ///< some lane was flagged by `step`
  double energy_ratio = 0;  ///< largest energy of a lane over its first one
  double outside_cone = 0;  ///< impulse of friction beyond μ f_n, share of the normal impulse
  double adhesion = 0;      ///< impulse pulling on the ground, share of the normal impulse
  double deepest = 0;       ///< m under z = 0, of any point at any time

  bool operator==(const SceneReport&) const = default;
};

Snapshot snapshot_of(Scene scene, const Character& character, std::uint64_t lane);
SceneReport run_scene(Scene scene, double rate, int passes);

}  // namespace mimicx::physics
