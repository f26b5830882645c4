#include "picture/moments.h"

namespace mimicx::picture {
namespace {

using Places = Eigen::Matrix<double, 3, kBodies>;

/// Joints relative to the pelvis, x the way the body looks.
Places places_of(const BodyPoses& poses) {
  const Quaterniond turn = rotation_z(-heading_angle(poses.q_WB[kPelvis]));
  Places places;
  for (int b = 0; b < kBodies; ++b) places.col(b) = turn * (poses.p_WB[b] - poses.p_WB[kPelvis]);
  return places;
}

}  // namespace

List<double> even_moments(const TimeSpan& stretch, int count) {
  if (count == 1) return {0.5 * (stretch.first + stretch.last)};
  List<double> moments;
  for (int k = 0; k < count; ++k)
    moments.push_back(stretch.first + (stretch.last - stretch.first) * k / (count - 1.0));
  return moments;
}

double telling_moment(const PosedMotion& motion, const TimeSpan& stretch) {
  const int first = motion.frame_at(stretch.first), last = motion.frame_at(stretch.last);
  Places mean = Places::Zero();
  for (int t = first; t <= last; ++t) mean += places_of(motion.poses[t]) / (last - first + 1.0);
  int best = first;
  double farthest = -1.0;
  for (int t = first; t <= last; ++t) {
    const double distance = (places_of(motion.poses[t]) - mean).squaredNorm();
    if (distance <= farthest) continue;
    farthest = distance;
    best = t;
  }
  return best / motion.fps;
}

}  // namespace mimicx::picture
