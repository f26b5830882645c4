#include "motion/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "motion/made_motions.h"
#include "motion/metrics.h"
#include "motion/repair.h"

namespace mimicx {
namespace {

using test::kPi;

std::vector<double> lowest_of(const Reference& r) {
  const auto points = surface_points(r.character);
  std::vector<double> z;
  for (const BodyPoses& pose : r.poses) z.push_back(lowest_height(points, pose));
  return z;
}

Clip lifted(Clip clip, const std::vector<double>& height) {
  for (std::size_t t = 0; t < clip.trans.size(); ++t) clip.trans[t].z() += height[t];
  return clip;
}

/// Heights of a ballistic jump that takes off at 1 s (m/s upwards, g = 9.81); 0 on the floor.
std::vector<double> jump_heights(int frames, double take_off_speed) {
  std::vector<double> z;
  for (int t = 0; t < frames; ++t) {
    const double s = t / 30.0 - 1.0;
    z.push_back(std::max(0.0, s > 0.0 ? take_off_speed * s - 0.5 * 9.81 * s * s : 0.0));
  }
  return z;
}

TEST(Differentiate, ConstantRatesAreExact) {
  const Vector3d velocity(0.5, -1, 0.25), spin = 2.0 * Vector3d(1, 2, -1).normalized();
  std::vector<ReferenceFrame> frames(20);
  for (std::size_t t = 0; t < frames.size(); ++t) {
    const double s = static_cast<double>(t) / 30.0;
    frames[t].p_root = s * velocity;
    frames[t].q.fill(exp_map(Vector3d(0.3, 0.1, -2)) * exp_map(s * spin));
  }
  differentiate(frames, 30.0);
  for (const ReferenceFrame& f : frames) {
    EXPECT_LT((f.v_root - velocity).norm(), 1e-12);
    for (const Vector3d& w : f.omega) EXPECT_LT((w - spin).norm(), 1e-10);
  }
}

/// R(t) = Rz(a)·Rx(b) has the body rate ḃ x + ȧ Rx(b)ᵀ z.
TEST(Differentiate, ConvergesQuadraticallyToTheBodyRateOfAnAnalyticRotation) {
  const auto a = [](double s) { return 1.5 * std::sin(2.0 * s); };
  const auto b = [](double s) { return 0.8 * std::cos(3.0 * s); };
  double previous = 0.0;
  for (const double fps : {30.0, 60.0, 120.0}) {
    std::vector<ReferenceFrame> frames(static_cast<std::size_t>(2 * fps));
    for (std::size_t t = 0; t < frames.size(); ++t) {
      const double s = static_cast<double>(t) / fps;
      frames[t].q.fill(rotation_z(a(s)) * exp_map(b(s) * Vector3d::UnitX()));
    }
    differentiate(frames, fps);
    double worst = 0.0;
    for (std::size_t t = 1; t + 1 < frames.size(); ++t) {
      const double s = static_cast<double>(t) / fps, da = 3.0 * std::cos(2.0 * s),
                   db = -2.4 * std::sin(3.0 * s);
      const Vector3d exact =
          db * Vector3d::UnitX() + da * (exp_map(-b(s) * Vector3d::UnitX()) * Vector3d::UnitZ());
      worst = std::max(worst, (frames[t].omega[kLeftHip] - exact).norm());
    }
    if (previous > 0.0) {
      EXPECT_NEAR(previous / worst, 4.0, 0.3);
    }
    previous = worst;
  }
}

TEST(Differentiate, IntegratesBackToTheMotion) {
  // The simulator's step: q(t+dt) ≈ q(t)·exp(dt·ω) with the mean of the rates of both ends.
  const Reference r = prepare_reference(test::random_clip(3, 60, 0.4), {}, nullptr);
  for (std::size_t t = 1; t + 2 < r.frames.size(); ++t) {
    const ReferenceFrame &f = r.frames[t], &next = r.frames[t + 1];
    EXPECT_LT((f.p_root + 0.5 / 30.0 * (f.v_root + next.v_root) - next.p_root).norm(), 0.003);
    for (const std::size_t j : std::initializer_list<std::size_t>{kPelvis, kSpine1, kNeck, kLeftCollar})
      EXPECT_LT((f.q[j] * exp_map(0.5 / 30.0 * (f.omega[j] + next.omega[j]))).angularDistance(next.q[j]),
                0.02);
  }
}

TEST(FloorCorrection, StaticShiftPutsTheSupportOnTheFloor) {
  for (const double height : {0.8, -0.3, 5.0}) {
    const FloorCorrection f = floor_correction(std::vector<double>(60, height), 30.0);
    EXPECT_NEAR(f.shift, -height, 1e-12);
    for (const double h : f.height) EXPECT_NEAR(h, -height, 1e-12);
  }
}

TEST(FloorCorrection, JumpsKeepTheirHeight) {
  for (const double speed : {1.5, 2.5, 3.5}) {
    const std::vector<double> z = jump_heights(90, speed);
    for (const double h : floor_correction(z, 30.0).height) EXPECT_NEAR(h, 0.0, 0.002) << speed;
  }
}

TEST(FloorCorrection, SlowDriftOfTheSupportIsRemovedUnderAJumpAsWell) {
  std::vector<double> z = jump_heights(150, 2.5), drift;
  for (std::size_t t = 0; t < z.size(); ++t) {
    drift.push_back(0.07 + 0.04 * std::sin(2 * kPi * static_cast<double>(t) / 150.0));
    z[t] += drift[t];
  }
  const FloorCorrection f = floor_correction(z, 30.0);
  // Within a window of the ends the support is seen from one side only.
  for (std::size_t t = 0; t < z.size(); ++t)
    EXPECT_NEAR(f.height[t], -drift[t], t < 18 || t > 131 ? 0.03 : 0.015) << t;
}

TEST(FloorCorrection, NothingStaysDeeperThanTenMillimetres) {
  Random random(2, {1});
  for (int n = 0; n < 20; ++n) {
    std::vector<double> z(100);
    for (double& v : z) v = 0.05 * random.normal() + (random.below(10) == 0 ? 0.3 * random.normal() : 0.0);
    const FloorCorrection f = floor_correction(z, 30.0);
    for (std::size_t t = 0; t < z.size(); ++t) EXPECT_GE(z[t] + f.height[t], -0.010 - 1e-12);
  }
}

TEST(FloorCorrection, NoiseOfAFewMillimetresIsNotFollowed) {
  Random random(2, {2});
  std::vector<double> z(120);
  for (double& v : z) v = 0.002 * random.normal();
  const FloorCorrection f = floor_correction(z, 30.0);
  for (std::size_t t = 1; t < z.size(); ++t) EXPECT_LT(std::abs(f.height[t] - f.height[t - 1]), 0.0003);
}

/// A pose thrown in for the frames [from, to).
Clip with_glitch(Clip clip, std::size_t from, std::size_t to, double size) {
  for (std::size_t t = from; t < to; ++t) clip.rotations[t][kLeftShoulder] += Vector3d(0, size, 0);
  return clip;
}

TEST(Glitches, ShortSpikesAreFlaggedAndNothingElse) {
  const Clip clean = test::random_clip(6, 90, 0.3);
  const auto none = find_glitches(clean);
  EXPECT_EQ(std::count(none.begin(), none.end(), true), 0);
  for (const auto& [from, to] : {std::pair<std::size_t, std::size_t>{40, 41}, {40, 45}, {0, 2}, {88, 90}}) {
    const auto flagged = find_glitches(with_glitch(clean, from, to, 2.0));
    for (std::size_t t = 0; t < 90; ++t) EXPECT_EQ(flagged[t], t >= from && t < to) << t << " of " << from;
  }
}

TEST(Glitches, ThrownPositionsAreFlagged) {
  Clip clip = test::random_clip(6, 90, 0.3);
  clip.trans[30].y() += 3.0;
  const auto flagged = find_glitches(clip);
  EXPECT_EQ(std::count(flagged.begin(), flagged.end(), true), 1);
  EXPECT_TRUE(flagged[30]);
}

TEST(Glitches, FastMotionsAndLastingChangesAreNotFlagged) {
  Clip kick =
      test::standing_clip(60, 1.0);  // the whole leg swings up to 30 rad/s and back in 0.4 s, smoothly
  for (std::size_t t = 20; t < 32; ++t)
    kick.rotations[t][kLeftHip].x() = -2.3 * std::pow(std::sin(kPi * static_cast<double>(t - 20) / 12.0), 2);
  const auto flagged = find_glitches(kick);
  EXPECT_EQ(std::count(flagged.begin(), flagged.end(), true), 0);
  Clip cut = test::random_clip(6, 90, 0.3);  // a cut in the video: jumps and stays
  for (std::size_t t = 45; t < 90; ++t) cut.trans[t].x() += 4.0;
  const auto after = find_glitches(cut);
  EXPECT_EQ(std::count(after.begin(), after.end(), true), 0);
}

TEST(Glitches, BridgingRestoresASmoothMotion) {
  const Clip clean = test::random_clip(6, 90, 0.3);
  Clip clip = with_glitch(clean, 40, 43, 2.0);
  bridge_glitches(clip, find_glitches(clip));
  for (std::size_t t = 0; t < 90; ++t)
    for (std::size_t j = 0; j < kBodies; ++j) {
      const double off = exp_map(clip.rotations[t][j]).angularDistance(exp_map(clean.rotations[t][j]));
      EXPECT_LT(off, t >= 40 && t < 43 ? 0.1 : 1e-7) << t;
    }
  Clip ends = with_glitch(clean, 0, 2, 2.0);
  bridge_glitches(ends, find_glitches(ends));
  EXPECT_EQ(ends.rotations[0], ends.rotations[1]);
  EXPECT_LT(exp_map(ends.rotations[0][5]).angularDistance(exp_map(clean.rotations[2][5])), 1e-7);
  Clip hopeless = clean;
  bridge_glitches(hopeless, std::vector<bool>(90, true));
  EXPECT_EQ(hopeless.rotations, clean.rotations);
}

TEST(Prepare, LiftedAndSunkMotionsStandOnTheFloor) {
  for (const double height : {0.4, -0.25}) {
    PreparationReport report;
    const Clip clip = test::standing_clip(60, test::standing_height() + height);
    const Reference r = prepare_reference(clip, {}, &report);
    for (const double z : lowest_of(r)) EXPECT_NEAR(z, 0.0, 1e-9);
    EXPECT_NEAR(report.floor_shift_mm, -1000 * height, 1e-6);
    EXPECT_NEAR(report.change_max_mm, 1000 * std::abs(height), 1e-6);
    EXPECT_LT(report.hinge_residual_max_mm, 1e-3);
    EXPECT_EQ(report.flagged_frames, 0);
    PreparationOptions off;
    off.ground = false;
    EXPECT_NEAR(lowest_of(prepare_reference(clip, off, nullptr))[30], height, 1e-9);
  }
}

TEST(Prepare, KeepsABallisticJump) {
  const std::vector<double> jump = jump_heights(90, 2.5);
  std::vector<double> height = jump;
  for (double& z : height) z += 0.06;  // floating, as video estimates do
  const Reference r =
      prepare_reference(lifted(test::standing_clip(90, test::standing_height()), height), {}, nullptr);
  const std::vector<double> z = lowest_of(r);
  for (std::size_t t = 0; t < 90; ++t) EXPECT_NEAR(z[t], jump[t], 0.003) << t;
  for (std::size_t t = 0; t < 90; ++t)
    if (jump[t] > 0.1) {
      EXPECT_NEAR((r.frames[t + 1].v_root - r.frames[t - 1].v_root).z() * 15.0, -9.81, 0.2);
    }
}

TEST(Prepare, BoundsPenetrationOfARandomMotion) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const Reference r = prepare_reference(test::random_clip(seed, 90, 0.3), {}, nullptr);
    for (const double z : lowest_of(r)) EXPECT_GE(z, -0.0101);
  }
}

TEST(Prepare, ResamplesTo30FpsOnTheCharacterOfTheClip) {
  Clip clip = test::random_clip(8, 121, 0.2, 120.0);
  clip.betas[0] = 1.0;
  const Reference r = prepare_reference(clip, {}, nullptr);
  EXPECT_EQ(r.fps, 30.0);
  EXPECT_EQ(r.size(), 31);
  EXPECT_EQ(r.poses.size(), 31u);
  EXPECT_EQ(r.flagged.size(), 31u);
  EXPECT_EQ(r.character.betas[0], 1.0);
  for (const ReferenceFrame& f : r.frames)
    for (const int hinge : {kLeftKnee, kRightKnee, kLeftElbow, kRightElbow})
      EXPECT_LT(log_map(f.q[static_cast<std::size_t>(hinge)]).cross(hinge_axis(hinge)).norm(), 1e-12);
}

TEST(Prepare, FlaggedFramesAreBridgedAndReported) {
  const Clip clip = with_glitch(test::random_clip(6, 90, 0.3), 40, 43, 2.0);
  PreparationReport report;
  const Reference r = prepare_reference(clip, {}, &report);
  EXPECT_EQ(report.flagged_frames, 3);
  EXPECT_TRUE(r.flagged[41]);
  EXPECT_GT(report.change_max_mm, 100.0);
  for (const ReferenceFrame& f : r.frames)
    for (const Vector3d& w : f.omega) EXPECT_LT(w.norm(), 25.0);
}

TEST(Prepare, OddFilesAreNoted) {
  const auto notes = [](const Clip& clip) {
    PreparationReport report;
    prepare_reference(clip, {}, &report);
    return report.notes;
  };
  EXPECT_TRUE(notes(test::standing_clip(30, test::standing_height())).empty());
  Clip lying = test::standing_clip(30, 0.3);
  for (auto& frame : lying.rotations) frame[0] = Vector3d::Zero();  // y up, taken for z up
  ASSERT_EQ(notes(lying).size(), 1u);
  EXPECT_NE(notes(lying)[0].find("z up"), std::string::npos);
  ASSERT_EQ(notes(test::standing_clip(30, 90.0)).size(), 1u);
  EXPECT_NE(notes(test::standing_clip(30, 90.0))[0].find("metres"), std::string::npos);
  Clip fast = test::standing_clip(30, test::standing_height());
  for (std::size_t t = 0; t < 30; ++t) fast.trans[t].x() = static_cast<double>(t);
  ASSERT_EQ(notes(fast).size(), 1u);
  EXPECT_NE(notes(fast)[0].find("speed"), std::string::npos);
}

TEST(Prepare, RefusesTooShortAndNonFiniteClips) {
  EXPECT_THROW(prepare_reference(test::standing_clip(1, 1.0), {}, nullptr), DataError);
  EXPECT_THROW(prepare_reference(test::standing_clip(3, 1.0, 120.0), {}, nullptr),
               DataError);  // one frame at 30 fps
  Clip broken = test::standing_clip(10, 1.0);
  broken.rotations[4][3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(prepare_reference(broken, {}, nullptr), DataError);
}

TEST(Prepare, ToClipIsTheInverseOfReadingAReference) {
  const Reference r = prepare_reference(test::random_clip(9, 40, 0.3), {}, nullptr);
  std::vector<Vector3d> p;
  std::vector<test::Rotations> q;
  for (const ReferenceFrame& f : r.frames) p.push_back(f.p_root), q.push_back(f.q);
  const auto poses = poses_of(to_clip("again", r.fps, r.character, p, q));
  for (std::size_t t = 0; t < poses.size(); ++t)
    for (std::size_t j = 0; j < kBodies; ++j) EXPECT_LT((poses[t].p_WB[j] - r.poses[t].p_WB[j]).norm(), 1e-9);
}

TEST(Prepare, RealClipsComeOutOnTheFloorAndLittleChanged) {
  namespace fs = std::filesystem;
  const fs::path motions = fs::path(MIMICX_SHARED_DIR) / "motions";
  if (!fs::exists(motions)) GTEST_SKIP() << "no folder of real motions here";
  for (const auto& entry : fs::directory_iterator(motions / "video")) {
    PreparationReport report;
    const Reference r = prepare_reference(read_clip(entry.path()), {}, &report);
    EXPECT_EQ(report.flagged_frames, 0) << entry.path();
    EXPECT_LT(report.change_mean_mm, 30.0) << entry.path();  // floor and levelled feet
    EXPECT_LT(report.hinge_residual_mean_mm, 2.0) << entry.path();
    const Metrics m = evaluate_motion(sample_motion(r.character, r.poses, r.fps), nullptr);
    EXPECT_LT(m.gp_max.value, 2.0) << entry.path();
    std::vector<double> z = lowest_of(r);
    std::nth_element(z.begin(), z.begin() + 15, z.end());
    EXPECT_NEAR(z[15], 0.0, 0.01) << entry.path();
  }
}

}  // namespace
}  // namespace mimicx
