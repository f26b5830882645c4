/// Violent contacts with the floor, and the errors of the contact law in them. The tests bound these errors,
/// tools/bench_contact prints them.
///
/// A scene runs for three seconds in every lane of a training pack, with self contact; the PD target is the
/// pose of the start. Impulses are summed over all points, lanes and steps.
#pragma once

#include "physics/test_states.h"

namespace mimicx::physics {

enum class ContactScene {
  kStand,
  kFall,
  kDrop,
  kThrow
};  ///< at rest; pushed over; from 1 m; 3 m/s and 3 rad/s
inline constexpr const char* kSceneNames[] = {"stand", "fall", "drop", "throw"};

/// Measurements of a scene.
struct SceneReport {
  bool wrong = false;       ///< `step` flagged a lane
  double energy_ratio = 0;  ///< largest energy of a lane over its first one
  double outside_cone = 0;  ///< impulse of friction beyond μ f_n, share of the normal impulse
  double adhesion = 0;      ///< impulse pulling on the ground, share of the normal impulse
  double deepest = 0;       ///< m under z = 0, of any point at any time
  double kinetic = 0;       ///< at the end, median of the lanes, J
  double load = 0;          ///< vertical force of the floor in the last half second, mean of all lanes, share
                            ///< of the weight

  bool operator==(const SceneReport&) const = default;
};

/// Of all bodies, J.
struct Energy {
  double kinetic = 0, potential = 0;
};
Energy energy_of(const Character& character, const Data<Pack<kLanes>>& d, int lane, double gravity);

Snapshot snapshot_of(ContactScene scene, const Character& character, std::uint64_t lane);
SceneReport run_scene(ContactScene scene, double rate, int passes);

}  // namespace mimicx::physics
