#include "report/motion_encoding.h"

#include <numbers>

#include "core/units.h"
#include "report/base64_digits.h"

namespace mimicx::report {
namespace {

constexpr int kFar = 3, kNear = 2;  ///< digits
constexpr double kTurn = 2048.0 / std::numbers::pi, kThousandth = 1000.0;

Vector3d in_whole_mm(const Vector3d& p) { return (kMm * p).array().round(); }

}  // namespace

std::string encode_poses(const std::vector<BodyPoses>& poses) {
  Digits digits;
  for (const BodyPoses& pose : poses) {
    for (const double x : in_whole_mm(pose.p_WB[kPelvis])) digits.put(x, kFar);
    for (const Quaterniond& q : pose.q_WB)
      for (const double angle : log_map(q)) digits.put(kTurn * angle, kNear);
  }
  return digits.text();
}

std::string encode_centers(const Character& character, const std::vector<BodyPoses>& poses) {
  Digits digits;
  for (const BodyPoses& pose : poses)
    for (const double x : in_whole_mm(center_of_mass(character, pose))) digits.put(x, kFar);
  return digits.text();
}

std::string encode_support(const std::vector<Polygon>& support, const std::vector<BodyPoses>& poses) {
  Digits digits;
  for (std::size_t t = 0; t < support.size(); ++t) {
    const Vector3d pelvis = in_whole_mm(poses[t].p_WB[kPelvis]);
    digits.put_count(static_cast<double>(support[t].size()), 1);
    for (const Eigen::Vector2d& corner : support[t])
      for (int k = 0; k < 2; ++k) digits.put(kMm * corner[k] - pelvis[k], kNear);
  }
  return digits.text();
}

std::string encode_ground(const std::vector<files::FloorArrows>& ground) {
  Digits digits;
  for (const files::FloorArrows& frame : ground)
    for (const files::FloorArrow& arrow : frame) {
      for (int k = 0; k < 2; ++k) digits.put(kMm * arrow.point[k], kFar);
      for (int k = 0; k < 3; ++k) digits.put(arrow.force[k], kFar);
    }
  return digits.text();
}

std::string encode_torques(const std::vector<PerBody<double>>& shares) {
  Digits digits;
  for (const PerBody<double>& frame : shares)
    for (const double share : frame) digits.put(kThousandth * share, kNear);
  return digits.text();
}

}  // namespace mimicx::report
