/// Real files, where they are there: every one is read and retargeted, and those that also exist in the AMASS
/// layout, converted by a program of its own from the same recordings, agree with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "import/bvh.h"
#include "import/deepmimic.h"
#include "import/retarget/retarget.h"
#include "import/text_input.h"
#include "motion/clip_file.h"
#include "motion/resample.h"

namespace mimicx::import {
namespace {

namespace fs = std::filesystem;

fs::path shared(const std::string& folder) { return fs::path(MIMICX_SHARED_DIR) / "motions" / folder; }

std::vector<fs::path> files_of(const std::string& folder) {
  std::vector<fs::path> files;
  if (fs::is_directory(shared(folder)))
    for (const auto& entry : fs::directory_iterator(shared(folder))) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

SkeletonMotion read(const fs::path& path) {
  const std::string text = read_text(path);
  return path.extension() == ".bvh" ? parse_bvh(text, path) : parse_deepmimic(text, path);
}

/// Largest mean residual over the limbs from hips and shoulders outwards, feet apart, mm.
double worst_limb(const RetargetReport& report) {
  double worst = 0.0;
  for (const int body : {kLeftHip, kLeftKnee, kLeftAnkle, kLeftShoulder, kLeftElbow, kLeftWrist, kRightHip,
                         kRightKnee, kRightAnkle, kRightShoulder, kRightElbow, kRightWrist})
    worst = std::max(worst, report.residual_mm[body]);
  return worst;
}

struct Bound {
  const char* names;     ///< beginning of the file's name
  double limb_mm, mean;  ///< 1.2 times what was measured when the bound was set
};

/// What is left comes from proportions that β cannot make: thighs and shanks stretch together, hips hardly
/// widen.
void expect_followed(const std::string& folder, std::size_t count, const std::vector<Bound>& bounds) {
  const auto files = files_of(folder);
  if (files.empty()) GTEST_SKIP() << "no shared motions in " << shared(folder);
  EXPECT_EQ(files.size(), count);
  for (const fs::path& path : files) {
    RetargetReport report;
    const SkeletonMotion motion = read(path);
    const motion::Clip clip = retarget(motion, {}, &report);
    const auto bound = std::find_if(bounds.begin(), bounds.end(),
                                    [&](const Bound& b) { return clip.name.starts_with(b.names); });
    ASSERT_NE(bound, bounds.end()) << path;
    EXPECT_LT(worst_limb(report), bound->limb_mm) << path;
    EXPECT_LT(report.mean_residual_mm, bound->mean) << path;
    EXPECT_GE(clip.frames(), motion.frames() - 1);
    EXPECT_EQ(report.up, 'y') << path;
    std::printf("%-42s %4d frames, residual %5.1f mm, worst limb %5.1f mm\n", clip.name.c_str(),
                clip.frames(), report.mean_residual_mm, worst_limb(report));
  }
}

TEST(RetargetShared, FollowsEveryBvhFile) {
  expect_followed("bvh", 17,
                  {{"dataset-", 14, 17},
                   {"indian", 51, 23},
                   {"martial", 45, 30},
                   {"cmu_01", 50, 26},
                   {"cmu_12", 110, 60},
                   {"neutral", 80, 30},
                   {"old", 85, 33},
                   {"strutting", 77, 33}});
}

TEST(RetargetShared, FollowsEveryDeepMimicFile) {
  expect_followed("deepmimic", 11, {{"humanoid3d", 26, 23}});
}

/// Mean distance (mm) of the joints, seen from the middle of the hips, after the one turn about the vertical
/// that aligns the clips best; the head apart, whose joint the conversions place differently.
double distance_mm(const motion::Clip& a, const motion::Clip& b) {
  const auto pa = motion::poses_of(a), pb = motion::poses_of(b);
  const std::size_t frames = std::min(pa.size(), pb.size());
  const auto relative = [](const BodyPoses& pose, int body) {
    return Vector3d(pose.p_WB[body] - 0.5 * (pose.p_WB[kLeftHip] + pose.p_WB[kRightHip]));
  };
  double sine = 0.0, cosine = 0.0;
  for (std::size_t t = 0; t < frames; ++t)
    for (int body = 0; body < kBodies; ++body) {
      const Vector3d x = relative(pa[t], body), y = relative(pb[t], body);
      sine += x.x() * y.y() - x.y() * y.x();
      cosine += x.x() * y.x() + x.y() * y.y();
    }
  const Quaterniond turn = rotation_z(std::atan2(sine, cosine));
  double sum = 0.0;
  for (std::size_t t = 0; t < frames; ++t)
    for (int body = 1; body < kBodies; ++body)
      if (body != kHead) sum += (turn * relative(pa[t], body) - relative(pb[t], body)).norm();
  return 1000.0 * sum / static_cast<double>(frames * (kJoints - 1));
}

TEST(RetargetShared, AgreesWithAnIndependentConversion) {
  if (files_of("amass").empty()) GTEST_SKIP() << "no shared motions in " << shared("amass");
  struct Pair {
    const char *source, *converted;
    double bound_mm;  ///< 1.3 times what was measured when the bound was set; the trunks differ, the limbs
                      ///< hardly
  };
  const std::vector<Pair> pairs = {
      {"bvh/dataset-1_kick_normal_001.bvh", "bandai_dataset-1_kick_normal_001", 42},
      {"bvh/dataset-1_walk_normal_001.bvh", "bandai_dataset-1_walk_normal_001", 33},
      {"bvh/dataset-2_walk-turn-left_normal_001.bvh", "bandai_dataset-2_walk-turn-left_normal_001", 23},
      {"bvh/indian_13.bvh", "cmu_bvh_indian_13", 24},
      {"deepmimic/humanoid3d_crawl.txt", "deepmimic_humanoid3d_crawl", 15},
      {"deepmimic/humanoid3d_dance_b.txt", "deepmimic_humanoid3d_dance_b", 15},
      {"deepmimic/humanoid3d_getup_facedown.txt", "deepmimic_humanoid3d_getup_facedown", 38},
      {"deepmimic/humanoid3d_jump.txt", "deepmimic_humanoid3d_jump", 28}};
  RetargetConfig config;
  config.standard_body = true;
  for (const Pair& pair : pairs) {
    const motion::Clip ours = motion::resampled(retarget(read(shared(pair.source)), config), 30.0);
    const motion::Clip theirs =
        motion::read_clip(shared("amass") / (pair.converted + std::string("_poses.npz")));
    EXPECT_NEAR(ours.frames(), theirs.frames(), 1);
    const double distance = distance_mm(ours, theirs);
    std::printf("%-42s %5.1f mm\n", ours.name.c_str(), distance);
    EXPECT_LT(distance, pair.bound_mm) << pair.source;
  }
}

}  // namespace
}  // namespace mimicx::import
