/// A motion with the poses, mesh and forces that drawing it needs.
#pragma once

#include <optional>
#include <string>

#include "files/exchange/exchange_file.h"
#include "files/floor_forces.h"
#include "motion/clip.h"
#include "render/solid.h"

namespace mimicx::picture {

struct PosedMotion {
  std::string label;
  double fps = 30.0;
  PerFrame<BodyPoses> poses;
  Character character;
  skin::Mesh mesh;
  Scene scene;
  List<files::FloorForces> forces;  ///< [frames − 1] means between frames; empty: no arrows

  double seconds() const { return (poses.count() - 1) / fps; }
  /// The frame nearest to a time, clamped to the first and last one.
  int frame_at(double time) const;
};

/// @param forces  of the floor, drawn as arrows; none: no arrows
PosedMotion posed_motion(const motion::Clip& clip, files::Skin skin,
                         const std::optional<files::RecordedForces>& forces);

/// The body at a frame with lighter left limbs, then the arrows of the floor's forces over the interval that
/// ends at the frame. Arrows have files::kMetresPerNewton per newton.
List<render::Solid> solids_at(const PosedMotion& motion, int frame, const render::Colour& colour);

/// The boxes of its scene.
List<render::Solid> scene_solids(const PosedMotion& motion);

}  // namespace mimicx::picture
