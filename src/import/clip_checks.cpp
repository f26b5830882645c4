#include "import/clip_checks.h"

#include <algorithm>

#include "core/quantile.h"
#include "import/landmarks.h"
#include "import/plausibility.h"
#include "motion/passthrough.h"

namespace mimicx::import {
namespace {

constexpr double kLargestAngle = 100.0;  ///< rad: sixteen turns of one joint
constexpr double kUsualAngle = 12.6;     ///< rad; larger angles in half of the frames are degrees
constexpr double kFastJoint = 12.0;      ///< m/s, as in motion/prepare/glitches.cpp
constexpr double kOverMotion = 3.0;      ///< ratio of the transition's speed to the motion's
constexpr double kLongestWayOut = 0.25;  ///< s, out of a T-pose
constexpr double kFastBody = 15.0;       ///< m/s of the pelvis
constexpr double kOverNeighbours = 5.0;  ///< a jump is so much faster than the steps around it
constexpr int kNeighbours = 3;           ///< steps on either side
constexpr int kNamed = 3;                ///< jumps that are named one by one

double largest_angle(const PerBody<Vector3d>& frame) {
  double most = 0.0;
  for (const Vector3d& rotation : frame) most = std::max(most, rotation.norm());
  return most;
}

/// The clip without its first frames.
void leave_out_first(int count, motion::Clip& clip) {
  const auto cut = [&](auto& rows) { rows.erase(rows.begin(), rows.begin() + count); };
  clip.passthrough = motion::last_frames(clip.passthrough, clip.rotations.size(),
                                         clip.rotations.size() - static_cast<std::size_t>(count));
  cut(clip.rotations);
  cut(clip.trans);
  if (!clip.keypoints) return;
  cut(clip.keypoints->uvc);
  if (clip.keypoints->extrinsics.size() > 1) cut(clip.keypoints->extrinsics);
}

/// Number of leading frames that are a T-pose or the transition out of it; 0 without a T-pose, or where a
/// human can make the transition. @param fastest  gets the largest speed of the transition, m/s
int t_pose_frames(const PerFrame<BodyPoses>& poses, double fps, double& fastest) {
  int first = 0;  // behind the T-pose
  while (first < poses.count() && is_t_pose({poses[first].p_WB, poses[first].q_WB})) ++first;
  if (first == 0 || first == poses.count()) return 0;
  const PerFrame<double> speeds = joint_speeds(poses, fps);
  const double human = std::max(kFastJoint, kOverMotion * median(speeds));
  const int longest = std::max(1, static_cast<int>(kLongestWayOut * fps));
  int way = 0;
  for (int t = first - 1; t < speeds.count() && way < longest && speeds[t] > human; ++t, ++way)
    fastest = std::max(fastest, speeds[t]);
  return way == 0 ? 0 : first - 1 + way;
}

}  // namespace

void repair_angles(const std::string& path, motion::Clip& clip) {
  std::vector<double> largest;
  PerFrame<int> bad;
  for (int t = 0; t < clip.frames(); ++t) {
    largest.push_back(largest_angle(clip.rotations[t]));
    if (largest.back() > kLargestAngle) bad.push_back(t);
  }
  if (!largest.empty() && median(largest) > kUsualAngle)
    throw DataError(path, "", "rotations in radians",
                    "an angle of " + short_number(median(largest)) + " in half of the frames (degrees?)");
  if (bad.empty()) return;
  const std::string found = "an angle of " + short_number(largest_angle(clip.rotations[bad.front()]));
  for (const int t : bad)
    for (int j = 0; j < kBodies; ++j)
      if (clip.rotations[t][j].norm() > kLargestAngle)
        clip.rotations[t][j] = t > 0 ? clip.rotations[t - 1][j] : Vector3d::Zero();
  clip.warnings.push_back(found + " rad in frame " + std::to_string(bad.front()) +
                          (bad.count() > 1 ? ", and in " + std::to_string(bad.count() - 1) + " more" : "") +
                          ": such joints keep the rotation of the frame before");
}

void remove_t_pose(motion::Clip& clip) {
  double fastest = 0.0;
  const int count = t_pose_frames(motion::poses_of(clip), clip.fps, fastest);
  if (count == 0 || clip.frames() - count < 2) return;
  leave_out_first(count, clip);
  clip.decide((count == 1 ? "the first frame is a T-pose"
                          : "the first " + std::to_string(count) + " frames are a T-pose") +
              std::string(" out of which the body moves at ") + short_number(fastest) + " m/s: removed");
}

void warn_of_jumps(motion::Clip& clip) {
  PerFrame<double> steps;  // of the pelvis, m
  for (int t = 1; t < clip.frames(); ++t) steps.push_back((clip.trans[t] - clip.trans[t - 1]).norm());
  std::vector<std::string> said;
  for (int t = 0; t < steps.count(); ++t) {
    if (!(steps[t] * clip.fps > kFastBody)) continue;
    const auto first = steps.begin() + std::max(0, t - kNeighbours);
    const auto end = steps.begin() + std::min(steps.count(), t + kNeighbours + 1);
    if (steps[t] <= kOverNeighbours * median(std::vector<double>(first, end))) continue;
    said.push_back(short_number(steps[t]) + " m from frame " + std::to_string(t) + " to " +
                   std::to_string(t + 1));
  }
  if (said.empty()) return;
  std::string line = "the body jumps by ";
  for (std::size_t i = 0; i < said.size() && i < kNamed; ++i) line += (i > 0 ? ", by " : "") + said[i];
  if (said.size() > kNamed) line += ", and " + std::to_string(said.size() - kNamed) + " times more";
  clip.warnings.push_back(line);
}

void require_in_view(const std::string& path, const motion::Clip& clip) {
  if (!clip.keypoints || clip.keypoints->extrinsics.empty()) return;
  const Vector3d pelvis = motion::rest_pelvis(clip);
  const auto& cameras = clip.keypoints->extrinsics;
  int behind = 0;
  for (int t = 0; t < clip.frames(); ++t) {
    const Eigen::Matrix4d& camera = motion::camera_at(cameras, t);
    const Vector3d place = clip.trans[t] + pelvis;
    if ((camera * place.homogeneous()).z() <= 0.0) ++behind;
  }
  if (2 * behind > clip.frames())
    throw DataError(path, "camera_extrinsics", "world to camera: the person in front of the camera",
                    "the person behind it in " + std::to_string(behind) + " of " +
                        std::to_string(clip.frames()) + " frames (camera to world?)");
}

}  // namespace mimicx::import
