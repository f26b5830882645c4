#include "picture/layout.h"

#include <gtest/gtest.h>

#include "motion/standing_clip.h"

namespace mimicx::picture {
namespace {

/// Walks along x without moving its legs. @param height  how much too high it stands, m
PosedMotion gliding(int frames, double height) {
  motion::Clip clip = motion::standing_clip(frames);
  for (int t = 0; t < frames; ++t) clip.trans[t] += Vector3d(0.05 * t, 0, height);
  return posed_motion(clip, files::Skin::kShapes, std::nullopt);
}

PictureConfig of_kind(Kind kind) {
  PictureConfig config;
  config.kind = kind;
  return config;
}

bool same_camera(const render::Camera& a, const render::Camera& b) {
  return a.R_CW == b.R_CW && a.p_WC == b.p_WC && a.focal == b.focal && a.centre == b.centre;
}

TEST(Layout, RowsOfAStripShowTheSameMomentsByTheSameCameras) {
  const List<PosedMotion> two = {gliding(61, 0.0), gliding(91, 0.1)};
  PictureConfig config = of_kind(Kind::kStrip);
  config.moments = 5;
  const Layout layout = lay_out(two, config);
  ASSERT_EQ(layout.pages.count(), 1);
  ASSERT_EQ(layout.pages[0].cells.count(), 10);
  EXPECT_EQ(layout.moments, (List<double>{0.0, 0.5, 1.0, 1.5, 2.0})) << "where both are";
  for (int c = 0; c < 5; ++c) {
    const Cell &upper = layout.pages[0].cells[c], &lower = layout.pages[0].cells[5 + c];
    EXPECT_EQ(upper.motion, 0);
    EXPECT_EQ(lower.motion, 1);
    EXPECT_EQ(upper.moments, lower.moments);
    EXPECT_EQ(upper.x, lower.x);
    EXPECT_TRUE(same_camera(upper.camera, lower.camera));
    const Vector3d way = upper.camera.p_WC - layout.pages[0].cells[0].camera.p_WC;
    EXPECT_TRUE(way.isApprox(Vector3d(0.05 * 15 * c, 0, 0), 1e-9)) << "it goes along over the floor";
  }
}

/// Every cell sees every body that it shows, whole.
void expect_all_seen(const List<PosedMotion>& motions, const Layout& layout) {
  for (const Page& page : layout.pages)
    for (const Cell& cell : page.cells) {
      EXPECT_LE(cell.x + cell.width, layout.size.width);
      EXPECT_LE(cell.y + cell.height, layout.size.height);
      const PosedMotion& p = motions[cell.motion];
      for (const double time : cell.moments)
        for (const render::Solid& solid : solids_at(p, p.frame_at(time), render::Colour::Ones()))
          for (const Vector3d& v : solid.vertices) {
            const Eigen::Vector2d at = cell.camera.projected(cell.camera.seen(v));
            ASSERT_TRUE(at.x() > 0 && at.y() > 0 && at.x() < cell.width && at.y() < cell.height)
                << at.transpose();
          }
    }
}

TEST(Layout, EveryKindShowsWholeBodiesAtAnySize) {
  const List<PosedMotion> two = {gliding(31, 0.0), gliding(31, 0.6)};
  for (const Kind kind : {Kind::kStill, Kind::kStroboscope, Kind::kStrip, Kind::kAnimation})
    for (const auto& size :
         {std::optional<Size>(), std::optional<Size>({400, 700}), std::optional<Size>({1100, 200})}) {
      PictureConfig config = of_kind(kind);
      config.size = size;
      config.view = 70.0;
      config.rate = 2.0;
      config.moments = 3;
      const Layout layout = lay_out(two, config);
      if (size) {
        EXPECT_TRUE(layout.size.width == size->width && layout.size.height == size->height);
      }
      expect_all_seen(two, layout);
    }
}

TEST(Layout, MomentsAreShownInTheOrderOfTime) {
  const List<PosedMotion> one = {gliding(61, 0.0)};
  for (const Kind kind : {Kind::kStrip, Kind::kStroboscope}) {
    PictureConfig config = of_kind(kind);
    config.at = {1.5, 0.5, 1.0};
    const Layout layout = lay_out(one, config);
    EXPECT_EQ(layout.moments, (List<double>{0.5, 1.0, 1.5}));
    EXPECT_EQ(layout.pages[0].time, 0.5);
    EXPECT_EQ(layout.pages[0].cells.back().moments.back(), 1.5);
  }
}

TEST(Layout, AnAnimationHasAPagePerFrameAndACameraThatStandsStill) {
  const List<PosedMotion> one = {gliding(31, 0.0)};
  PictureConfig config = of_kind(Kind::kAnimation);
  config.rate = 10.0;
  config.stretch = {0.2, 0.8};
  const Layout layout = lay_out(one, config);
  ASSERT_EQ(layout.pages.count(), 7);
  for (int k = 0; k < 7; ++k) {
    EXPECT_NEAR(layout.pages[k].time, 0.2 + 0.1 * k, 1e-12);
    EXPECT_TRUE(same_camera(layout.pages[k].cells[0].camera, layout.pages[0].cells[0].camera));
  }
}

TEST(Layout, TheViewIsRelativeToTheBody) {
  const List<PosedMotion> one = {gliding(2, 0.0)};  // looks along -y
  const auto from = [&](double view) {
    PictureConfig config = of_kind(Kind::kStill);
    config.view = view;
    const Vector3d away = lay_out(one, config).pages[0].cells[0].camera.R_CW.row(2);
    return Vector3d(-Vector3d(away.x(), away.y(), 0).normalized());
  };
  EXPECT_TRUE(from(0.0).isApprox(-Vector3d::UnitY(), 1e-6)) << from(0.0).transpose();
  EXPECT_TRUE(from(90.0).isApprox(-Vector3d::UnitX(), 1e-6)) << "its right side";
}

std::string complaint(const List<PosedMotion>& motions, const PictureConfig& config) {
  try {
    lay_out(motions, config);
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(Layout, RejectsMomentsOutsideTheMotionAndTooSmallPictures) {
  const List<PosedMotion> one = {gliding(31, 0.0)};
  PictureConfig config = of_kind(Kind::kStrip);
  config.at = {0.5, 1.2};
  EXPECT_EQ(complaint(one, config), "1.20 s is not in the motion, which ends at 1.00 s");
  config.at.clear();
  config.stretch.first = 3.0;
  EXPECT_EQ(complaint(one, config), "3.00 s is not in the motion, which ends at 1.00 s");
  config.stretch.first = 0.0;
  config.moments = 40;
  config.size = Size{300, 100};
  EXPECT_EQ(complaint(one, config), "a picture of 40 x 1 cells does not fit into 300 x 100 pixels");
}

}  // namespace
}  // namespace mimicx::picture
