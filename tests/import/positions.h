/// Clips as arrays of joint positions, the way motion generators write them.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "import/joint_positions.h"
#include "import/world_transform.h"

namespace mimicx::test {

/// (frames, 22, 3) joints of every frame, y up, times `scale`.
inline NpyArray positions_of(const motion::Clip& clip, double scale = 1.0) {
  const Quaterniond to_y_up = import::rotation_to_z_up('y').conjugate();
  std::vector<double> values;
  for (const BodyPoses& pose : motion::poses_of(clip))
    for (int b = 0; b < kBodies; ++b)
      for (const double x : Vector3d(scale * (to_y_up * pose.p_WB[b]))) values.push_back(x);
  const auto frames = static_cast<std::size_t>(clip.frames());
  return NpyArray::from_double({frames, kBodies, 3}, values.data());
}

/// HumanML3D's features (frames, 263) of positions, by its definition: what the reader must undo. Those that
/// follow from the others are 0.
inline NpyArray features_of(const NpyArray& positions, double normalised = 1.0) {
  const Eigen::MatrixXd rows = to_matrix(positions);
  const auto joint = [&](Eigen::Index t, int b) { return Vector3d(rows.row(t).segment<3>(3 * b)); };
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(rows.rows(), import::kHumanMl3dFeatures);
  std::vector<Quaterniond> to_heading;  // takes the direction faced to z
  for (Eigen::Index t = 0; t < rows.rows(); ++t) {
    Vector3d forward = (joint(t, kLeftHip) - joint(t, kRightHip)).cross(Vector3d::UnitY());
    forward.y() = 0.0;
    to_heading.push_back(rotation_between(forward, Vector3d::UnitZ()));
  }
  for (Eigen::Index t = 0; t < rows.rows(); ++t) {
    const auto next = std::min(t + 1, rows.rows() - 1);
    const Quaterniond turn =
        to_heading[static_cast<std::size_t>(next)] * to_heading[static_cast<std::size_t>(t)].conjugate();
    out(t, 0) = std::atan2(turn.y(), turn.w());
    const Vector3d step = to_heading[static_cast<std::size_t>(next)] * (joint(next, 0) - joint(t, 0));
    out(t, 1) = step.x();
    out(t, 2) = step.z();
    out(t, 3) = joint(t, 0).y();
    for (int b = 1; b < kBodies; ++b) {
      Vector3d local = joint(t, b);
      local.x() -= joint(t, 0).x();
      local.z() -= joint(t, 0).z();
      out.row(t).segment<3>(4 + 3 * (b - 1)) = to_heading[static_cast<std::size_t>(t)] * local;
    }
  }
  return from_matrix(normalised * out);
}

}  // namespace mimicx::test
