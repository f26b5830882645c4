#include "generate/pose_numbers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/error.h"

namespace mimicx::generate {
namespace {

using Row = Eigen::Matrix<float, 1, kPoseNumbers>;

/// Rotation of an upright pelvis of heading 0.
Quaterniond upright() {
  const Quaterniond up = exp_map(Vector3d::UnitX() * (0.5 * std::numbers::pi));
  return rotation_z(-heading_angle(up)) * up;
}

/// Height of the pelvis over the soles of the upright body at rest, m.
double pelvis_height(const Character& character) {
  PerBody<Quaterniond> q;
  q.fill(Quaterniond::Identity());
  q[0] = upright();
  return -lowest_contact(character, forward_kinematics(character, Vector3d::Zero(), q));
}

}  // namespace

nn::Matrix<float> pose_numbers(const motion::Clip& clip) {
  motion::require_usable(clip, 2);
  if (std::abs(clip.fps - kFramesPerSecond) > 0.01)
    raise(DataError(clip.name, "frame rate", "30 frames per second", std::to_string(clip.fps)));
  const double scale = pelvis_height(make_character()) / pelvis_height(motion::character_of(clip));
  const auto rotations = motion::joint_rotations(clip);
  const Vector3d rest = motion::rest_pelvis(clip);
  const Quaterniond from_upright = upright().conjugate();
  nn::Matrix<float> numbers(clip.frames(), kPoseNumbers);
  Vector3d before = Vector3d::Zero();
  double heading_before = 0.0;
  for (int t = 0; t < clip.frames(); ++t) {
    const Vector3d pelvis = scale * (clip.trans[t] + rest);
    const double heading = heading_angle(rotations[t][0]);
    Row row = Row::Zero();
    if (t > 0) {
      const Vector3d way = rotation_z(-heading_before) * (pelvis - before);
      row.head<2>() = way.head<2>().transpose().cast<float>();
      row[2] = static_cast<float>(std::remainder(heading - heading_before, 2.0 * std::numbers::pi));
    }
    row[3] = static_cast<float>(pelvis.z());
    row.segment<3>(4) =
        log_map(rotation_z(-heading) * rotations[t][0] * from_upright).transpose().cast<float>();
    for (int body = 1; body < kBodies; ++body)
      row.segment<3>(4 + 3 * body) = log_map(rotations[t][body]).transpose().cast<float>();
    numbers.row(t) = row;
    before = pelvis;
    heading_before = heading;
  }
  numbers.row(0).head<3>() = numbers.row(1).head<3>();
  return numbers;
}

motion::Clip clip_of_numbers(const std::string& name, const nn::Matrix<float>& numbers) {
  const auto frames = static_cast<int>(numbers.rows());
  PerFrame<Vector3d> p_root(frames);
  PerFrame<PerBody<Quaterniond>> q(frames);
  Vector3d place = Vector3d::Zero();
  double heading = 0.0;
  for (int t = 0; t < frames; ++t) {
    const Eigen::Matrix<double, 1, kPoseNumbers> row = numbers.row(t).cast<double>();
    if (t > 0) {
      place += rotation_z(heading) * Vector3d(row[0], row[1], 0.0);
      heading += row[2];
    }
    p_root[t] = {place.x(), place.y(), row[3]};
    q[t][0] = rotation_z(heading) * exp_map(row.segment<3>(4).transpose()) * upright();
    for (int body = 1; body < kBodies; ++body) q[t][body] = exp_map(row.segment<3>(4 + 3 * body).transpose());
  }
  return motion::to_clip(name, kFramesPerSecond, make_character(), p_root, q);
}

void require_learnable(std::span<const LabelledMotion> motions, int labels, int frames) {
  if (motions.empty()) raise(std::invalid_argument("a generator learns at least one motion"));
  for (const LabelledMotion& motion : motions)
    if (motion.numbers.rows() < frames || motion.label < 0 || motion.label >= labels)
      raise(std::invalid_argument("a generator learns motions of at least " + std::to_string(frames) +
                                  " frames, of labels below " + std::to_string(labels)));
}

nn::Matrix<float> rows_of(std::span<const LabelledMotion> motions) {
  Eigen::Index rows = 0;
  for (const LabelledMotion& motion : motions) rows += motion.numbers.rows();
  nn::Matrix<float> all(rows, kPoseNumbers);
  rows = 0;
  for (const LabelledMotion& motion : motions) {
    all.middleRows(rows, motion.numbers.rows()) = motion.numbers;
    rows += motion.numbers.rows();
  }
  return all;
}

void write_condition(int label, int labels, double share, int frames, float* row) {
  std::fill(row, row + condition_numbers(labels), 0.0F);
  row[label] = 1.0F;
  const double place = std::clamp(share, 0.0, 1.0) * (kHats - 1);
  const int below = std::min(static_cast<int>(place), kHats - 2);
  row[labels + below] = static_cast<float>(1.0 - (place - below));
  row[labels + below + 1] = static_cast<float>(place - below);
  row[labels + kHats] = static_cast<float>(frames / (10.0 * kFramesPerSecond));
}

}  // namespace mimicx::generate
