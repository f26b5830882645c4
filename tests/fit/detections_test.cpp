/// Detections that are exchanged, missing or far off, and those of the feet.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit/fitted_clips.h"

namespace mimicx::fit {
namespace {

using namespace test;

/// Mean angle between the ankles of two clips, degrees.
double ankle_error(const motion::Clip& a, const motion::Clip& b) {
  const PerFrame<BodyPoses> p = motion::poses_of(a), q = motion::poses_of(b);
  double sum = 0.0;
  for (int t = 0; t < p.count(); ++t)
    for (const int body : {kLeftAnkle, kRightAnkle})
      sum += p[t].q_WB[body].angularDistance(q[t].q_WB[body]) / (2.0 * p.count() * kDegree);
  return sum;
}

TEST(Fit, FootKeypointsCorrectTheAnkles) {
  const motion::Clip truth = truth_of("kick");
  const auto fitted = [&](motion::KeypointSet set) {
    return fit_keypoints(disturbed(truth, 1, set), exact_camera(), nullptr);
  };
  const double without = ankle_error(truth, fitted(motion::KeypointSet::kCoco17)),
               with = ankle_error(truth, fitted(motion::KeypointSet::kCoco133));
  EXPECT_LT(with, 0.7 * without);
  EXPECT_LT(with, 2.0);
}

/// The clip with left and right of its keypoints exchanged in these frames.
motion::Clip exchanged(motion::Clip clip, std::size_t first, std::size_t end) {
  for (std::size_t t = first; t < end; ++t) {
    for (const std::size_t left : std::initializer_list<std::size_t>{
             kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot, kLeftShoulder, kLeftElbow, kLeftWrist})
      std::swap(clip.keypoints->uvc[t][left], clip.keypoints->uvc[t][left + 1]);
  }
  return clip;
}

/// Whether a note of the fit has these words.
bool notes(const FitReport& report, const std::string& words) {
  return std::any_of(report.notes.begin(), report.notes.end(),
                     [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

TEST(Fit, TellsThatKeypointsAreOfAnotherMotion) {
  const motion::Clip squat = truth_of("squat"), bow = truth_of("bow");
  motion::Clip input = disturbed(squat, 3), other = disturbed(bow, 3);
  const int frames = std::min(squat.frames(), bow.frames());
  FitReport of_own, of_other;
  fit_keypoints(input, exact_camera(), &of_own);
  EXPECT_TRUE(of_own.notes.empty()) << of_own.notes[0];
  input.rotations.resize(static_cast<std::size_t>(frames));
  input.trans.resize(static_cast<std::size_t>(frames));
  input.keypoints = other.keypoints;
  input.keypoints->uvc.resize(static_cast<std::size_t>(frames));
  fit_keypoints(input, exact_camera(), &of_other);
  EXPECT_TRUE(notes(of_other, "keypoints of this motion") ||
              notes(of_other, "of this motion, and of this camera"));
}

TEST(Fit, TellsThatSidesAreExchangedThroughout) {
  const motion::Clip input = disturbed(truth_of("walk"), 3);
  FitReport report;
  fit_keypoints(exchanged(input, 0, input.rotations.size()), exact_camera(), &report);
  EXPECT_TRUE(notes(report, "left and right of the keypoints are exchanged in"));
}

TEST(Fit, RestoresABurstOfExchangedSides) {
  const motion::Clip truth = truth_of("walk"), input = disturbed(truth, 3);
  const motion::Clip expected = fit_keypoints(input, exact_camera(), nullptr);
  const motion::Clip swapped = exchanged(input, 30, 38);
  FitReport report;
  const motion::Clip fitted = fit_keypoints(swapped, exact_camera(), &report);
  EXPECT_EQ(report.swapped_frames, 8);
  EXPECT_TRUE(fitted.keypoints->uvc == input.keypoints->uvc);
  EXPECT_LT(against(expected, fitted).gmpjpe.value, 0.5);
}

TEST(Fit, IgnoresDetectionsWithoutConfidence) {
  const motion::Clip truth = truth_of("walk");
  motion::Clip zeros = disturbed(truth, 4), garbage = zeros;
  Random random(1, {});
  int dropped = 0;
  for (std::size_t t = 0; t < zeros.keypoints->uvc.size(); ++t)
    for (std::size_t k = 0; k < kBodies; ++k)
      if (random.uniform() < 0.2) {
        zeros.keypoints->uvc[t][k].setZero();
        garbage.keypoints->uvc[t][k] = Vector3d(1e4 * random.normal(), -5e3, 0.0);
        ++dropped;
      }
  FitReport report;
  const motion::Clip a = fit_keypoints(zeros, exact_camera(), &report);
  const motion::Clip b = fit_keypoints(garbage, exact_camera(), nullptr);
  EXPECT_EQ(report.dropped_points, dropped);
  EXPECT_TRUE(a.rotations == b.rotations && a.trans == b.trans);
  EXPECT_LT(against(truth, a).mpjpe.value, 9.0);
}

TEST(Fit, ResistsFarOffDetections) {
  const motion::Clip truth = truth_of("squat");
  motion::Clip input = disturbed(truth, 4);
  Random random(2, {});
  for (auto& frame : input.keypoints->uvc)
    for (Vector3d& point : frame)
      if (random.uniform() < 0.05)
        point.head<2>() += 300.0 * Eigen::Vector2d(random.normal(), random.normal());
  const motion::Metrics after = against(truth, fit_keypoints(input, exact_camera(), nullptr));
  EXPECT_LT(after.mpjpe.value, 10.0);
  EXPECT_LT(after.mrpe.value, 25.0);
}

/// Mean distance of some bodies of two clips over some frames, relative to the pelvis, mm.
double error_where(const motion::Clip& a, const motion::Clip& b, int first, int last,
                   const std::vector<int>& bodies) {
  const PerFrame<BodyPoses> p = motion::poses_of(a), q = motion::poses_of(b);
  double sum = 0.0;
  for (int t = first; t < last; ++t)
    for (const int body : bodies)
      sum += (p[t].p_WB[body] - p[t].p_WB[0] - q[t].p_WB[body] + q[t].p_WB[0]).norm();
  return kMm * sum / static_cast<double>(bodies.size()) / (last - first);
}

const std::vector<int> kLegs = {kLeftHip,   kRightHip,   kLeftKnee, kRightKnee,
                                kLeftAnkle, kRightAnkle, kLeftFoot, kRightFoot};

/// Sums over three draws of the noise: its static errors are so large that a single draw says little.
TEST(Fit, ImprovesTwoSecondsWithoutDetections) {
  std::vector<int> all(kBodies);
  std::iota(all.begin(), all.end(), 0);
  const motion::Clip truth = synthetic_clip("walk", 5, 90);
  for (const char* preset : {"gvhmr", "vibe"}) {
    double before = 0.0, after = 0.0, before_inside = 0.0, after_inside = 0.0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      motion::Clip noisy = noisy_of(truth, preset, motion::KeypointSet::kJoints22, seed);
      for (int t = 15; t < 75; ++t)
        for (Vector3d& point : noisy.keypoints->uvc[t]) point.setZero();
      const motion::Clip fitted = fit_keypoints(noisy, {}, nullptr);
      before += error_where(noisy, truth, 15, 75, all), after += error_where(fitted, truth, 15, 75, all);
      before_inside += error_where(noisy, truth, 35, 55, all);
      after_inside += error_where(fitted, truth, 35, 55, all);
    }
    EXPECT_LT(after, before) << preset;
    EXPECT_LT(after_inside, before_inside) << preset;
  }
}

/// Sums over three draws, as above.
TEST(Fit, UnseenLegsDoNotGetWorse) {
  constexpr int kFrames = 45;
  for (const char* preset : {"gvhmr", "vibe"})
    for (const char* kind : {"walk", "squat"}) {
      const motion::Clip truth = synthetic_clip(kind, 5, kFrames);
      double legs_before = 0.0, legs_after = 0.0, before = 0.0, after = 0.0;
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        motion::Clip noisy = noisy_of(truth, preset, motion::KeypointSet::kCoco17, seed);
        for (auto& frame : noisy.keypoints->uvc)
          for (std::size_t k = 11; k < 17; ++k) frame[k].setZero();  // hips, knees, ankles
        const motion::Clip fitted = fit_keypoints(noisy, {}, nullptr);
        legs_before += error_where(noisy, truth, 0, kFrames, kLegs);
        legs_after += error_where(fitted, truth, 0, kFrames, kLegs);
        before += against(truth, noisy).mpjpe.value, after += against(truth, fitted).mpjpe.value;
      }
      EXPECT_LE(legs_after, legs_before) << preset << " " << kind;
      EXPECT_LT(after, before) << preset << " " << kind;
    }
}

}  // namespace
}  // namespace mimicx::fit
