/// A motion on its body, ready to be drawn at any time.
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
  List<files::FloorForces> forces;  ///< [frames − 1] of the intervals between frames; empty: not shown

  double seconds() const { return (poses.count() - 1) / fps; }
  /// The frame nearest to a time; the first and the last beyond the ends.
  int frame_at(double time) const;
};

/// @param forces  what the floor does, to be shown as arrows; none: no arrows
PosedMotion posed_motion(const motion::Clip& clip, files::Skin skin,
                         const std::optional<files::RecordedForces>& forces);

/// The body at a frame, its left limbs lighter than the rest, and behind it the arrows of the floor's forces
/// over the interval that ends there, files::kMetresPerNewton long.
List<render::Solid> solids_at(const PosedMotion& motion, int frame, const render::Colour& colour);

}  // namespace mimicx::picture
