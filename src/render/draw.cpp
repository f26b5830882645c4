#include "render/draw.h"

#include <algorithm>
#include <stdexcept>

#include "core/parallel.h"
#include "render/raster.h"
#include "render/shading.h"

namespace mimicx::render {
namespace {

constexpr int kSide = 3;           ///< samples along a pixel's edge
constexpr int kBand = 32;          ///< rows of pixels per task of a thread
constexpr double kNearest = 0.05;  ///< near plane: distance from the camera, m

/// The samples of some rows of a picture.
struct Samples {
  Samples(int first_row, int w, int h)
      : first(first_row), width(w), height(h), nearness(w * h, 0.0F), light(w * h, background()) {}
  int first, width, height;  ///< first row of samples; size in samples
  List<float> nearness;      ///< 1 / depth, 1/m, which is linear on a picture; 0: empty
  List<Colour> light;
};

/// A solid projected onto the samples.
struct Projected {
  List<double> nearness;  ///< [V] 1 / depth, 1/m; 0: behind the near plane
  List<GridPoint> corners;
};

Camera magnified(Camera camera) {
  camera.focal *= kSide;
  camera.centre *= kSide;
  return camera;
}

Projected projected(const Solid& solid, const Camera& camera) {
  Projected out;
  for (const Vector3d& p : solid.vertices) {
    const Vector3d p_C = camera.seen(p);
    const bool before = p_C.z() > kNearest;
    out.nearness.push_back(before ? 1.0 / p_C.z() : 0.0);
    out.corners.push_back(before ? on_grid(camera.projected(p_C)) : GridPoint{});
  }
  return out;
}

/// Draws one triangle. @param corner  clockwise on the picture
void draw_triangle(const Solid& solid, const Projected& on, const std::array<int, 3>& corner,
                   const Shading& shading, Samples& samples) {
  const int a = corner[0], b = corner[1], c = corner[2];
  const Vector3d nearness(on.nearness[a], on.nearness[b], on.nearness[c]);
  GridTriangle triangle = {on.corners[a], on.corners[b], on.corners[c]};
  for (GridPoint& p : triangle) p.y -= kSubSteps * samples.first;
  for_each_sample(triangle, samples.width, samples.height, [&](int x, int y, const Vector3d& on_picture) {
    const double near = on_picture.dot(nearness);
    const int k = y * samples.width + x;
    if (static_cast<float>(near) <= samples.nearness[k]) return;
    const Vector3d w = on_picture.cwiseProduct(nearness) / near;  // of the corners, in the world's triangle
    const Vector3d p = w[0] * solid.vertices[a] + w[1] * solid.vertices[b] + w[2] * solid.vertices[c];
    if (p.z() < 0.0) return;  // under the floor
    const Vector3d normal = w[0] * solid.normals[a] + w[1] * solid.normals[b] + w[2] * solid.normals[c];
    const Eigen::Vector3f share = w.cast<float>();
    samples.nearness[k] = static_cast<float>(near);
    samples.light[k] = shading.of_solid(
        p, normal.normalized(),
        share[0] * solid.colours[a] + share[1] * solid.colours[b] + share[2] * solid.colours[c]);
  });
}

void draw_solid(const Solid& solid, const Projected& on, const Shading& shading, Samples& samples) {
  for (const auto& [a, b, c] : solid.triangles)
    if (on.nearness[a] > 0.0 && on.nearness[b] > 0.0 && on.nearness[c] > 0.0)
      draw_triangle(solid, on, {a, c, b}, shading, samples);  // the picture's y axis points down
}

/// Draws the floor at samples without a solid.
void draw_floor(const Camera& camera, const Shading& shading, Samples& samples) {
  for (int y = 0; y < samples.height; ++y)
    for (int x = 0; x < samples.width; ++x) {
      const int k = y * samples.width + x;
      if (samples.nearness[k] > 0.0F) continue;
      const Vector3d ray = camera.ray(x + 0.5, samples.first + y + 0.5);
      const double depth = -camera.p_WC.z() / ray.z();
      if (ray.z() < 0.0 && depth > kNearest)
        samples.light[k] = shading.of_floor(camera.p_WC + depth * ray, depth * ray.norm());
    }
}

/// Averages the samples of every pixel.
void develop(const Samples& samples, Image& image) {
  for (int y = 0; y < samples.height / kSide; ++y)
    for (int x = 0; x < image.width; ++x) {
      Colour sum = Colour::Zero();
      for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) sum += samples.light[(y * kSide + j) * samples.width + x * kSide + i];
      image.at(x, samples.first / kSide + y) = shown(sum / (kSide * kSide));
    }
}

}  // namespace

Image draw(const List<Solid>& solids, const Camera& camera, int width, int height, int threads) {
  if (width < 1 || height < 1) throw std::invalid_argument("draw: a picture has pixels");
  List<Solid> things = solids;
  std::erase_if(things, [](const Solid& solid) { return solid.is_sign; });
  const Shading shading(things, camera);
  const Camera fine = magnified(camera);
  List<Projected> on;
  for (const Solid& solid : solids) on.push_back(projected(solid, fine));
  Image image(width, height, {});
  parallel_for((height + kBand - 1) / kBand, threads, [&](int band) {
    const int first = band * kBand, rows = std::min(kBand, height - first);
    Samples samples(kSide * first, kSide * width, kSide * rows);
    const auto draw_all = [&](bool signs) {
      for (int k = 0; k < solids.count(); ++k)
        if (solids[k].is_sign == signs) draw_solid(solids[k], on[k], shading, samples);
    };
    draw_all(false);
    draw_floor(fine, shading, samples);
    samples.nearness.assign(samples.nearness.size(), 0.0F);
    draw_all(true);
    develop(samples, image);
  });
  return image;
}

}  // namespace mimicx::render
