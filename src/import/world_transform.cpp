#include "import/world_transform.h"

#include <cctype>
#include <numbers>
#include <stdexcept>

#include "motion/keypoint_members.h"

namespace mimicx::import {
namespace {

/// Puts the pelvis elsewhere: @param place  Vector3d(Vector3d) of the pelvis' position
template <class Place>
void place_pelvis(const Place& place, motion::Clip& clip) {
  const Vector3d pelvis = motion::rest_pelvis(clip);
  for (Vector3d& trans : clip.trans) trans = place(Vector3d(trans + pelvis)) - pelvis;
}

/// world → camera, of a world that `change` (4 × 4) takes to the new one.
void move_cameras(const Eigen::Matrix4d& change, motion::Clip& clip) {
  motion::change_cameras(
      [&](Eigen::Matrix4d& extrinsics) { extrinsics = (extrinsics * change.inverse()).eval(); }, clip);
}

}  // namespace

void rotate_world(const Quaterniond& R, motion::Clip& clip) {
  place_pelvis([&](const Vector3d& p) { return Vector3d(R * p); }, clip);
  for (auto& frame : clip.rotations) frame[0] = log_map(R * exp_map(frame[0]));
  Eigen::Matrix4d change = Eigen::Matrix4d::Identity();
  change.topLeftCorner<3, 3>() = R.toRotationMatrix();
  move_cameras(change, clip);
}

void scale_world(double scale, motion::Clip& clip) {
  for (Vector3d& trans : clip.trans) trans *= scale;
  motion::change_cameras([&](Eigen::Matrix4d& extrinsics) { extrinsics.topRightCorner<3, 1>() *= scale; },
                         clip);
}

void shift_world(const Vector3d& shift, motion::Clip& clip) {
  for (Vector3d& trans : clip.trans) trans += shift;
  for (Plate& plate : clip.scene.plates) plate.centre += shift.head<2>();
  Eigen::Matrix4d change = Eigen::Matrix4d::Identity();
  change.topRightCorner<3, 1>() = shift;
  move_cameras(change, clip);
}

Quaterniond rotation_to_z_up(char axis) {
  const auto turn = [](double quarters, const Vector3d& about) {
    return rotation_about(about, quarters * std::numbers::pi / 2);
  };
  switch (axis) {
    case 'x':
      return turn(-1, Vector3d::UnitY());
    case 'X':
      return turn(1, Vector3d::UnitY());
    case 'y':
      return turn(1, Vector3d::UnitX());
    case 'Y':
      return turn(-1, Vector3d::UnitX());
    case 'z':
      return Quaterniond::Identity();
    case 'Z':
      return turn(2, Vector3d::UnitX());
    default:
      throw std::invalid_argument(std::string("an axis is x, y or z, not '") + axis + "'");
  }
}

char axis_letter(const Vector3d& direction) {
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return (direction[axis] < 0.0 ? "XYZ" : "xyz")[axis];
}

std::string axis_name(char axis) {
  std::string name(std::isupper(static_cast<unsigned char>(axis)) ? "-" : "");
  name += static_cast<char>(std::tolower(static_cast<unsigned char>(axis)));
  return name;
}

}  // namespace mimicx::import
