/// A picture of solids on a checked floor, by a rasteriser with a depth buffer.
///
/// Nine samples per pixel, 3 × 3, in linear light. The light is one lamp, above and beside the camera, and a
/// bright sky. Both throw soft shadows on the floor (floor_shadow.h), and the lamp also on the solids. The
/// floor z = 0 has checks of half a metre and hides what is below it.
///
/// Equal scenes give equal pixels with any number of threads: bands of rows are drawn independently. It has
/// no transparency and no reflection, and skips triangles with a corner behind the camera.
#pragma once

#include "render/camera.h"
#include "render/solid.h"

namespace mimicx::render {

Image draw(const List<Solid>& solids, const Camera& camera, int width, int height, int threads);

}  // namespace mimicx::render
