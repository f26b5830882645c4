#include "rl/tracking/keypoints.h"

#include <algorithm>
#include <limits>

namespace mimicx::rl::tracking {

List<KeypointFrame> match_keypoints(const motion::Keypoints& keypoints) {
  List<KeypointFrame> frames(keypoints.uvc.size());
  for (std::size_t t = 0; t < frames.size(); ++t) {
    KeypointFrame& frame = frames[t];
    const Eigen::Matrix4d& extrinsics = motion::camera_at(keypoints.extrinsics, static_cast<int>(t));
    frame.projection = keypoints.intrinsics * extrinsics.topRows<3>();
    double top = std::numeric_limits<double>::infinity(), bottom = -top;
    for (std::size_t k = 0; k < keypoints.names.size(); ++k) {
      const Vector3d& uvc = keypoints.uvc[t][k];
      const int body = body_of_name(keypoints.names[k]);
      if (!(uvc.z() > 0.0) || body < 0) continue;
      frame.detections.push_back({body, uvc.x(), uvc.y(), uvc.z()});
      top = std::min(top, uvc.y());
      bottom = std::max(bottom, uvc.y());
    }
    frame.box_height = bottom - top;
    if (!(frame.box_height > 1.0)) frame.detections.clear();  // a single point, or a person of zero height
  }
  return frames;
}

double projection_error(const KeypointFrame& keypoints, const PerBody<Vector3d>& p_WB) {
  double sum = 0.0, weights = 0.0;
  for (const auto& d : keypoints.detections) {
    const Vector3d image = keypoints.projection * p_WB[d.body].homogeneous();
    if (image.z() < 1e-3) continue;  // behind the camera: it has no pixel
    const double off_u = image.x() / image.z() - d.u, off_v = image.y() / image.z() - d.v;
    sum += d.weight * (off_u * off_u + off_v * off_v);
    weights += d.weight;
  }
  return weights > 0.0 ? sum / (weights * keypoints.box_height * keypoints.box_height) : 0.0;
}

}  // namespace mimicx::rl::tracking
