#include "character/standard_body.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "core/units.h"

namespace mimicx {

namespace {

/// A body of the middle or the left side, and its joint.
struct StandardBody {
  int body;
  std::array<double, 3> offset;  ///< from the parent's joint, m
  double mass_share;
  double kp, torque_limit, armature;  ///< N·m/rad, N·m, kg·m²
  std::array<double, 3> centre_deg,
      half_range_deg;  ///< of the anatomical range; a hinge has three equal entries
};

constexpr StandardBody kStandardBodies[] = {
    {kPelvis, {0.0, 0.0, 0.0}, 0.118, 0, 0, 0, {}, {}},  // no joint
    {kSpine1, {0.0, 0.108, -0.026}, 0.082, 1000, 250, 0.02, {10, 0, 0}, {50, 45, 45}},
    {kSpine2, {0.0, 0.136, 0.001}, 0.082, 1000, 250, 0.02, {10, 0, 0}, {50, 45, 45}},
    {kSpine3, {0.0, 0.054, 0.026}, 0.112, 1000, 250, 0.02, {10, 0, 0}, {50, 45, 45}},
    {kNeck, {0.0, 0.214, -0.042}, 0.012, 150, 50, 0.01, {0, 0, 0}, {55, 65, 50}},
    {kHead, {0.0, 0.066, 0.050}, 0.056, 100, 40, 0.01, {0, 0, 0}, {55, 65, 50}},
    {kLeftHip, {0.066, -0.088, -0.006}, 0.1446, 500, 250, 0.02, {-45, 0, 10}, {95, 75, 75}},
    {kLeftKnee, {0.040, -0.382, -0.004}, 0.0457, 500, 220, 0.02, {75, 75, 75}, {82, 82, 82}},
    {kLeftAnkle, {-0.012, -0.402, -0.040}, 0.0113, 400, 200, 0.02, {12, 0, 0}, {62, 60, 50}},
    {kLeftFoot, {0.024, -0.056, 0.122}, 0.0022, 100, 40, 0.01, {-15, 0, 0}, {65, 30, 30}},
    {kLeftCollar, {0.074, 0.118, -0.034}, 0.0181, 500, 130, 0.02, {0, 0, 5}, {45, 45, 45}},
    {kLeftShoulder, {0.096, 0.034, -0.010}, 0.0263, 400, 120, 0.02, {0, -25, -10}, {130, 125, 130}},
    {kLeftElbow, {0.258, -0.014, -0.026}, 0.0150, 300, 80, 0.02, {77, 77, 77}, {85, 85, 85}},
    {kLeftWrist, {0.250, 0.008, -0.001}, 0.0058, 80, 20, 0.01, {0, 0, 0}, {140, 90, 95}},
};

/// The row of a body; of the right side that of its mirror image.
const StandardBody& standard_row(int body) {
  const int left = is_right(body) ? body - 1 : body;
  return *std::find_if(std::begin(kStandardBodies), std::end(kStandardBodies),
                       [&](const StandardBody& row) { return row.body == left; });
}

Vector3d vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

Vector3d standard_offset(int body) { return vector_of(standard_row(body).offset); }

double mass_share(int body) { return standard_row(body).mass_share; }

std::vector<std::array<int, 2>> make_self_pairs() {
  std::vector<std::array<int, 2>> pairs;
  for (int arm : {kLeftElbow, kRightElbow, kLeftWrist, kRightWrist}) {
    for (int other : {kPelvis, kSpine1, kSpine2, kSpine3, kHead, kLeftHip, kRightHip})
      pairs.push_back({arm, other});
    for (int lower_leg : {kLeftKnee, kRightKnee, kLeftAnkle, kRightAnkle})
      if (arm == kLeftWrist || arm == kRightWrist) pairs.push_back({arm, lower_leg});
  }
  pairs.insert(pairs.end(), {{kLeftWrist, kRightWrist},
                             {kLeftWrist, kRightElbow},
                             {kLeftElbow, kRightWrist},
                             {kLeftElbow, kRightElbow},
                             {kLeftHip, kRightHip},
                             {kLeftHip, kRightKnee},
                             {kLeftKnee, kRightHip},
                             {kLeftKnee, kRightKnee},
                             {kLeftAnkle, kRightAnkle},
                             {kLeftAnkle, kRightKnee},
                             {kLeftKnee, kRightAnkle},
                             {kLeftFoot, kRightAnkle},
                             {kLeftAnkle, kRightFoot},
                             {kLeftFoot, kRightFoot}});
  return pairs;
}

JointParameters standard_joint(int body) {
  const StandardBody& row = standard_row(body);
  Vector3d centre = vector_of(row.centre_deg);
  // In the mirror, rotations about y and z change sign. 0 − y instead of −y leaves no negative zero.
  if (is_right(body) && !is_hinge(body)) centre = {centre.x(), 0.0 - centre.y(), 0.0 - centre.z()};
  return {row.kp,           0.1 * row.kp,     row.armature,
          row.torque_limit, kDegree * centre, kDegree * vector_of(row.half_range_deg)};
}

}  // namespace mimicx
