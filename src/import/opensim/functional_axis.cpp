#include "import/opensim/functional_axis.h"

#include "core/decompositions.h"
#include "motion/procrustes.h"

namespace mimicx::import {
namespace {

constexpr double kLeastTurn = 0.04;    ///< rad, RMS over √2
constexpr double kLeastSpread = 0.01;  ///< m; markers nearer to one line do not say how a segment turns

/// Poses of a segment relative to that of its first frame, about the mean of its markers.
struct SegmentPoses {
  PerFrame<Matrix3d> R;
  Track t;
};

motion::Points points_at(const std::vector<Track>& markers, int frame) {
  motion::Points points(3, static_cast<Eigen::Index>(markers.size()));
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) = markers[static_cast<std::size_t>(i)][frame];
  return points;
}

std::optional<SegmentPoses> segment_poses(const std::vector<Track>& markers) {
  if (markers.size() < 3) return std::nullopt;
  motion::Points rest = points_at(markers, 0);
  rest.colwise() -= Vector3d(rest.rowwise().mean());
  if (!(symmetric_eigen(rest * rest.transpose()).values[1] > kLeastSpread * kLeastSpread))
    return std::nullopt;
  SegmentPoses poses;
  for (int t = 0; t < markers[0].count(); ++t) {
    const motion::Similarity moved = motion::nearest_similarity(rest, points_at(markers, t), true);
    poses.R.push_back(moved.R);
    poses.t.push_back(moved.offset);
  }
  return poses;
}

}  // namespace

std::optional<JointLine> functional_axis(const std::vector<Track>& upper, const std::vector<Track>& lower) {
  const auto one = segment_poses(upper), two = segment_poses(lower);
  if (!one || !two) return std::nullopt;
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Vector6d right = Vector6d::Zero();
  const int frames = one->t.count();
  for (int t = 0; t < frames; ++t) {
    Eigen::Matrix<double, 3, 6> row;
    row << one->R[t], -two->R[t];
    normal += row.transpose() * row / frames;
    right += row.transpose() * (two->t[t] - one->t[t]) / frames;
  }
  const SymmetricEigen modes = symmetric_eigen(normal);
  if (!(modes.values[1] > kLeastTurn * kLeastTurn)) return std::nullopt;
  Vector6d point = Vector6d::Zero();  // the shortest solution without the axis' direction
  for (int k = 1; k < 6; ++k) {
    const Vector6d direction = modes.vectors.col(k);
    point += direction.dot(right) / modes.values[k] * direction;
  }
  const Vector6d axis = modes.vectors.col(0);
  JointLine line;
  for (int t = 0; t < frames; ++t) {
    line.point.push_back(0.5 *
                         (one->R[t] * point.head<3>() + one->t[t] + two->R[t] * point.tail<3>() + two->t[t]));
    line.direction.push_back((one->R[t] * axis.head<3>() + two->R[t] * axis.tail<3>()).normalized());
  }
  return line;
}

}  // namespace mimicx::import
