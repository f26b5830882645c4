#include "motion/resample.h"

#include <algorithm>
#include <stdexcept>

#include "motion/passthrough.h"

namespace mimicx::motion {
namespace {

constexpr std::size_t kMostFrames = 300000;  ///< that a lower rate is made to: nearly three hours at 30 fps

constexpr double kEnd = 0.05;  ///< frames

/// A keypoint at a frame (`share` 0), or between two. Where both detected it, one between them is
/// interpolated and keeps the lower confidence; else it is that of the nearer frame.
Vector3d interpolate_keypoint(const Vector3d& a, const Vector3d& b, double share) {
  if (share == 0.0 || a.z() <= 0.0 || b.z() <= 0.0) return share < 0.5 ? a : b;
  Vector3d uvc = (1.0 - share) * a + share * b;
  uvc.z() = std::min(a.z(), b.z());
  return uvc;
}

Eigen::Matrix4d interpolate_pose(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b, double share) {
  const Quaterniond p(Matrix3d(a.topLeftCorner<3, 3>())), q(Matrix3d(b.topLeftCorner<3, 3>()));
  Eigen::Matrix4d pose = (1.0 - share) * a + share * b;
  pose.topLeftCorner<3, 3>() = slerp(p, share, q).toRotationMatrix();
  return pose;
}

}  // namespace

Clip resampled(const Clip& clip, double fps) {
  if (!(fps > 0.0)) throw std::invalid_argument("resampled: the frame rate must be positive");
  if (clip.fps == fps || clip.frames() == 0) return clip;
  const int frames = clip.frames();
  const auto q = joint_rotations(clip);
  const double ratio = clip.fps / fps;
  // The last frame is included if only the rounding of a frame rate (30.0003 for 30) separates it from the
  // end.
  const auto count = static_cast<std::size_t>((frames - 1) / ratio + kEnd) + 1;
  if (count > std::max(kMostFrames, clip.rotations.size()))
    throw DataError(clip.name, "", "at most " + std::to_string(kMostFrames) + " frames at the new frame rate",
                    std::to_string(count) + " (is the frame rate right?)");
  Clip out = clip;
  out.fps = fps;
  out.rotations.resize(count);
  out.trans.resize(count);
  if (out.keypoints) {
    out.keypoints->uvc.resize(count);
    if (clip.keypoints->extrinsics.size() > 1) out.keypoints->extrinsics.resize(count);
  }
  for (int k = 0; k < out.frames(); ++k) {
    const auto [t, n, share] = locate_rows(k * ratio, clip.rotations.size());
    for (int j = 0; j < kBodies; ++j) out.rotations[k][j] = log_map(slerp(q[t][j], share, q[n][j]));
    out.trans[k] = (1.0 - share) * clip.trans[t] + share * clip.trans[n];
    if (!out.keypoints) continue;
    const auto &a = clip.keypoints->uvc[t], &b = clip.keypoints->uvc[n];
    out.keypoints->uvc[k].resize(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
      out.keypoints->uvc[k][i] = interpolate_keypoint(a[i], b[i], share);
    const auto& camera = clip.keypoints->extrinsics;
    if (camera.size() > 1) out.keypoints->extrinsics[k] = interpolate_pose(camera[t], camera[n], share);
  }
  out.passthrough = resampled_members(clip.passthrough, clip.rotations.size(), count, ratio);
  return out;
}

}  // namespace mimicx::motion
