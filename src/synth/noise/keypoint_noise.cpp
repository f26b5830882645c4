#include "synth/noise/keypoint_noise.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "synth/noise/occlusion.h"
#include "synth/noise/random_processes.h"

namespace mimicx::synth {
namespace {

constexpr double kPercent = 0.01;
constexpr double kKeypointTau = 0.25, kHiddenTau = 0.15, kConfidenceTau = 0.3;  // s
constexpr int kTailFreedom = 3;  ///< of Student's t of the errors frame by frame
constexpr double kConfusionShortest = 2, kConfusionLongest = 12, kGapShortest = 2, kGapLongest = 8;  // frames
constexpr double kMeanConfidence = 0.8, kLeastConfidence = 0.05;
constexpr double kTypicalError = 0.01;  ///< of the box: of a detection of mean confidence
constexpr double kFarOdds = 2.0;        ///< bound of the logarithm of an error over the typical one

/// A detector's idea of a joint: o + A v in the limb's frame, v the unit vector towards the eye.
struct Offset {
  Vector3d limb = Vector3d::Zero();
  Matrix3d view = Matrix3d::Zero();
};

Offset drawn_offset(const NoisePreset& p, std::uint64_t seed, std::size_t k) {
  Random limb(seed, {kLimbOffsetStream, k}), view(seed, {kViewOffsetStream, k});
  Offset offset;
  for (double& entry : offset.limb) entry = p.offset_limb * limb.normal();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) offset.view(row, column) = p.offset_view * view.normal();
  return offset;
}

/// What a keypoint's errors are drawn from, over time: `wander` and `hidden` in percent of the box.
struct ErrorNoise {
  PerFrame<double> wander_u, wander_v, hidden_u, hidden_v, confidence;
  Random tail;
};

ErrorNoise drawn_noise(const NoisePreset& p, std::uint64_t seed, std::size_t k, int frames, double fps) {
  Random wander(seed, {kWanderStream, k}), hidden(seed, {kHiddenStream, k}),
      confidence(seed, {kConfidenceStream, k});
  ErrorNoise noise{{}, {}, {}, {}, {}, Random(seed, {kTailStream, k})};
  noise.wander_u = smooth_error(wander, frames, p.wander, kKeypointTau * fps);
  noise.wander_v = smooth_error(wander, frames, p.wander, kKeypointTau * fps);
  noise.hidden_u = smooth_error(hidden, frames, p.occlusion, kHiddenTau * fps);
  noise.hidden_v = smooth_error(hidden, frames, p.occlusion, kHiddenTau * fps);
  noise.confidence =
      smooth_error(confidence, frames, p.confidence_spread == 0.0 ? 0.0 : 1.0, kConfidenceTau * fps);
  return noise;
}

/// Error of a detection in parts of the box. @param noise  its tail is advanced
Eigen::Vector2d detection_error(const NoisePreset& p, ErrorNoise& noise, int t, double short_by,
                                bool hidden) {
  Eigen::Vector2d error(noise.wander_u[t], noise.wander_v[t]);
  if (p.tail != 0.0) {
    const double u = student_t(noise.tail, kTailFreedom), v = student_t(noise.tail, kTailFreedom);
    error += p.tail * Eigen::Vector2d(u, v);
  }
  error *= 1.0 + p.foreshortening * short_by;
  if (hidden) error += Eigen::Vector2d(noise.hidden_u[t], noise.hidden_v[t]);
  return kPercent * error;
}

/// Confidence that is only weakly correlated with how good a detection is. @param error  in parts of the box
double drawn_confidence(const NoisePreset& p, double noise, double error) {
  const double good = std::clamp(log(kTypicalError / std::max(error, 1e-9)), -kFarOdds, kFarOdds);
  const double belief =
      p.confidence_truth * good + std::sqrt(1.0 - p.confidence_truth * p.confidence_truth) * noise;
  return std::clamp(kMeanConfidence + p.confidence_spread * belief, kLeastConfidence, 1.0);
}

/// Exchanges left and right of arms, legs, both, or hands only, for a few frames.
void mix_up_sides(const std::vector<Landmark>& points, double rate, std::uint64_t seed, double fps,
                  PerFrame<std::vector<Vector3d>>& uvc) {
  static constexpr Array<int, 4> kMixed = {kLeftHip, kLeftShoulder, kLeftElbow, kLeftKnee};
  Random random(seed, {kMixUpStream});
  for (const Interval& interval :
       poisson_intervals(random, rate, kConfusionShortest, kConfusionLongest, uvc.count(), fps)) {
    const int limb = kMixed[random.below(kMixed.size())];
    for (int t = interval.first; t < interval.first + interval.length; ++t)
      for (std::size_t k = 0; k < points.size(); ++k)
        if (is_descendant(points[k].body, limb)) std::swap(uvc[t][k], uvc[t][mirror_of(points, k)]);
  }
}

/// Frames without any detection, and single points that are missing.
void leave_out(const NoisePreset& p, std::uint64_t seed, double fps, PerFrame<std::vector<Vector3d>>& uvc) {
  Random gaps(seed, {kGapStream}), misses(seed, {kMissStream});
  for (const Interval& gap : poisson_intervals(gaps, p.gap_rate, kGapShortest, kGapLongest, uvc.count(), fps))
    for (int t = gap.first; t < gap.first + gap.length; ++t)
      std::fill(uvc[t].begin(), uvc[t].end(), Vector3d::Zero());
  for (auto& frame : uvc)
    for (Vector3d& point : frame)
      if (misses.uniform() < p.drop_share) point.setZero();
}

}  // namespace

BodyPoses pose_between(const SeenMotion& motion, double frame) {
  const int last = motion.q.count() - 1;
  const double time = std::clamp(frame, 0.0, static_cast<double>(last));
  const int before = std::min(static_cast<int>(time), std::max(last - 1, 0)),
            after = std::min(before + 1, last);
  const double part = time - before;
  PerBody<Quaterniond> q;
  for (int b = 0; b < kBodies; ++b) q[b] = slerp(motion.q[before][b], part, motion.q[after][b]);
  return forward_kinematics(motion.character,
                            (1.0 - part) * motion.p_root[before] + part * motion.p_root[after], q);
}

double foreshortening(const BodyPoses& poses, const Landmark& point, const Vector3d& eye) {
  const int from = point.body == kPelvis ? static_cast<int>(kSpine1) : kParents[point.body];
  const Vector3d end = poses.p_WB[point.body] + poses.q_WB[point.body] * point.p_B;
  const double angle = angle_between(end - poses.p_WB[from], end - eye);
  return 1.0 - sin(angle);
}

motion::Keypoints detect_keypoints(const SeenMotion& truth, const CameraPath& camera, motion::KeypointSet set,
                                   const NoisePreset& preset, std::uint64_t seed) {
  const std::vector<Landmark> points = landmarks(set);
  const int frames = truth.q.count();
  const double late = preset.time_offset * Random(seed, {kTimeOffsetStream}).normal();
  motion::Keypoints keypoints;
  keypoints.names = motion::keypoint_names(set);
  keypoints.intrinsics = camera.intrinsics;
  keypoints.extrinsics = camera.extrinsics;
  keypoints.uvc.assign(frames, std::vector<Vector3d>(points.size()));
  PerFrame<BodyPoses> seen;
  PerFrame<double> boxes;
  for (int t = 0; t < frames; ++t) {
    seen.push_back(pose_between(truth, t - late));
    boxes.push_back(box_size(camera.at(t), seen[t]));
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Offset offset = drawn_offset(preset, seed, k);
    ErrorNoise noise = drawn_noise(preset, seed, k, frames, truth.fps);
    for (int t = 0; t < frames; ++t) {
      const Camera view = camera.at(t);
      const Vector3d eye = motion::eye_of(view.extrinsics);
      const Vector3d& p_WB = seen[t].p_WB[points[k].body];
      const Quaterniond& q_WB = seen[t].q_WB[points[k].body];
      const Vector3d joint = p_WB + q_WB * points[k].p_B;
      const Vector3d to_eye = q_WB.conjugate() * (eye - joint).normalized();
      const Vector3d found = joint + q_WB * (offset.limb + offset.view * to_eye);
      const Eigen::Vector2d error =
          detection_error(preset, noise, t, foreshortening(seen[t], points[k], eye),
                          preset.occlusion > 0.0 && is_hidden(truth.character, seen[t], eye, joint));
      const Eigen::Vector2d uv = project(view, found).head<2>() + boxes[t] * error;
      const double off = (uv - project(view, joint).head<2>()).norm() / boxes[t];
      keypoints.uvc[t][k] = {uv.x(), uv.y(), drawn_confidence(preset, noise.confidence[t], off)};
    }
  }
  mix_up_sides(points, preset.swap_rate, seed, truth.fps, keypoints.uvc);
  leave_out(preset, seed, truth.fps, keypoints.uvc);
  return keypoints;
}

}  // namespace mimicx::synth
