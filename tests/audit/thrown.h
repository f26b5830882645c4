/// A violent motion with every force recorded, for the tests of the audit.
#pragma once

#include "audit/audit.h"
#include "core/random.h"
#include "core/temporary_folder.h"
#include "rl/tracking/tracking_fixture.h"

namespace mimicx::audit {

/// Two seconds of a character dropped by 5 cm whose targets jump about 30 times a second, every step
/// recorded.
/// @param size  of the jumps, rad per axis: 0.3 makes it thrash and fall
/// @param scene  it stands on what is under the origin
/// @param character  its bones nearly as long as the standard ones
struct Thrown {
  rl::tracking::TrackingConfig config;
  motion::Reference reference = rl::tracking::swaying_reference(60);
  rl::tracking::TrackingRollout rollout;

  explicit Thrown(double rate = 240.0, double size = 0.08, const Scene& scene = {},
                  const Character& character = make_character({1.0, -2.0, 0.5, 0.0, 1.5})) {
    config.simulation.rate = rate;
    reference.character = character;
    reference.scene = scene;
    const double height = scene.height_under({0.0, 0.0, 1e9});
    for (auto& f : reference.frames) f.p_root.z() += 0.05 + height;
    const auto clip = rl::tracking::make_tracking_clip(reference, config);
    int call = 0;
    rollout = rl::tracking::roll_out(
        clip, config,
        [&](int, const float*, float* action) {
          // Of the streams 71 to 82 this one is the second most violent. In 71 float32 leaves 58 N
          // unexplained in one step.
          Random random(73, {static_cast<std::uint64_t>(call++)});
          for (int k = 0; k < kDofs; ++k) action[k] = static_cast<float>(size * random.normal());
        },
        true);
  }
  SubstepMotion steps() const {
    return {reference.character, config.simulation, rollout.substeps, rollout.last_state, reference.scene};
  }
  SimulatedFrames frames() const {
    SimulatedFrames motion{reference.character, reference.fps, {}, rollout.forces};
    for (const auto& pose : rollout.poses) motion.frames.push_back(pose.frame);
    return motion;
  }
  Audit audit() const { return audit_frames(frames(), config.simulation); }
};

/// As `mimicx audit` sees it.
inline SubstepMotion written_and_read(const SubstepMotion& motion) {
  const TemporaryFolder folder;
  write_substeps(folder.path / "s.npz", motion);
  return read_substeps(read_npz(folder.path / "s.npz"));
}

}  // namespace mimicx::audit
