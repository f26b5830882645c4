#include "picture/picture.h"

#include <gtest/gtest.h>

#include "core/file.h"
#include "core/temporary_folder.h"
#include "files/pushed_clip.h"

namespace mimicx::picture {
namespace {

PictureConfig small(Kind kind) {
  PictureConfig config;
  config.kind = kind;
  config.moments = 3;
  config.rate = 10.0;
  config.size = Size{240, 160};
  return config;
}

List<PosedMotion> two() {
  const motion::Clip clip = files::pushed_clip(12);
  return {posed_motion(clip, files::Skin::kShapes, std::nullopt),
          posed_motion(clip, files::Skin::kShapes, files::recorded_forces(clip))};
}

TEST(Picture, IsByteIdenticalForAnyNumberOfThreads) {
  TemporaryFolder folder;
  const List<PosedMotion> motions = two();
  for (const Kind kind : {Kind::kStill, Kind::kStroboscope, Kind::kStrip, Kind::kAnimation}) {
    const std::filesystem::path file = folder.path / "a.png";
    const Layout layout = lay_out(motions, small(kind));
    std::string first;
    for (const int threads : {1, 1, 2, 3}) {
      write_picture(file, motions, layout, 10.0, threads);
      const std::string bytes = read_file(file);
      if (first.empty()) first = bytes;
      EXPECT_EQ(bytes, first) << threads;
    }
  }
}

TEST(Picture, DrawsArrowsOnlyWhereForcesAreRecorded) {
  const List<PosedMotion> motions = two();
  List<PosedMotion> without = motions;
  without[1].forces.clear();
  PictureConfig config = small(Kind::kStill);
  config.at = {4 / 25.0};
  const Layout layout = lay_out(motions, config);
  const render::Image a = draw_page(motions, layout.pages[0], layout.size, 1),
                      b = draw_page(without, layout.pages[0], layout.size, 1);
  int left = 0, right = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      if (a.at(x, y) != b.at(x, y)) ++(x < a.width / 2 ? left : right);
  EXPECT_EQ(left, 0) << "the motion without forces";
  EXPECT_GT(right, 50);
}

TEST(Picture, DrawsTheBoxesOfTheScene) {
  List<PosedMotion> motions = two();
  EXPECT_TRUE(scene_solids(motions[0]).empty());
  PictureConfig config = small(Kind::kStill);
  const Layout layout = lay_out(motions, config);
  const render::Image flat = draw_page(motions, layout.pages[0], layout.size, 1);
  const Vector3d feet = motions[0].poses[0].p_WB[kLeftAnkle];
  motions[0].scene.plates = {{feet.head<2>(), 0.3, {0.3, 0.3}, 0.2}};
  const render::Image boxed = draw_page(motions, layout.pages[0], layout.size, 1);
  int left = 0;
  for (int y = 0; y < flat.height; ++y)
    for (int x = 0; x < flat.width / 2; ++x) left += flat.at(x, y) != boxed.at(x, y) ? 1 : 0;
  EXPECT_GT(left, 200);
}

TEST(Picture, AnArrowIsAsLongAsItsForceAndBeginsWhereItActs) {
  const List<PosedMotion> motions = two();
  const List<render::Solid> solids = solids_at(motions[1], 4, render::Colour::Ones());
  const files::FloorForces& forces = motions[1].forces[3];
  int arrow = 1;
  for (const files::FloorForce& force : forces) {
    if (!force.loaded) continue;
    double farthest = 0.0;
    for (const Vector3d& v : solids[arrow].vertices) farthest = std::max(farthest, (v - force.point).norm());
    EXPECT_NEAR(farthest, std::max(0.001 * force.force.norm(), 0.03), 0.01);
    ++arrow;
  }
  EXPECT_EQ(arrow, solids.count());
  EXPECT_GT(arrow, 2);
}

TEST(Picture, LeftLimbsAreLighter) {
  const PosedMotion body = posed_motion(motion::standing_clip(2), files::Skin::kShapes, std::nullopt);
  const render::Solid solid = solids_at(body, 0, {0.1F, 0.2F, 0.5F})[0];
  for (int v = 0; v < solid.vertices.count(); ++v) {
    const int limb = kLimbOf[body.mesh.joints[v][0]];
    EXPECT_EQ(solid.colours[v].x() > 0.2F, limb == 1 || limb == 3) << v;
  }
}

}  // namespace
}  // namespace mimicx::picture
