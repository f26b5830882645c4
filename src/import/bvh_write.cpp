#include "import/bvh_write.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/elementary.h"
#include "core/number_text.h"
#include "core/units.h"

namespace mimicx::import {
namespace {

std::string number(double value) {
  return formatted("%.9f", value == 0.0 ? 0.0 : value);  // no "-0"
}

std::string triple(const Vector3d& v) { return number(v.x()) + ' ' + number(v.y()) + ' ' + number(v.z()); }

/// An angle (degrees) turned by full turns until it is within half a turn of `near`.
double unwrapped(double angle, double near) { return angle - 360.0 * std::round((angle - near) / 360.0); }

/// R = Rz(a) Ry(b) Rx(c) → (a, b, c) in degrees. Of both solutions, plus any full turns, it returns the one
/// nearest to `near`, so that curves do not jump.
Vector3d zyx_angles(const Matrix3d& R, const Vector3d& near) {
  const double cosine = hypot(R(2, 1), R(2, 2)), b = atan2(-R(2, 0), cosine) / kDegree;
  double a, c;
  if (cosine > 1e-9) {
    a = atan2(R(1, 0), R(0, 0)) / kDegree;
    c = atan2(R(2, 1), R(2, 2)) / kDegree;
  } else {  // gimbal lock: only a ∓ c matters
    c = near.z();
    const double turned = atan2(-R(0, 1), R(1, 1)) / kDegree;  // a − c for b = 90°, a + c for −90°
    a = b > 0.0 ? turned + c : turned - c;
  }
  const auto nearest = [&](double x, double y, double z) {
    return Vector3d(unwrapped(x, near.x()), unwrapped(y, near.y()), unwrapped(z, near.z()));
  };
  const Vector3d first = nearest(a, b, c), second = nearest(a + 180.0, 180.0 - b, c + 180.0);
  return (second - near).norm() < (first - near).norm() ? second : first;
}

bool has_children(int body) { return std::find(kParents.begin(), kParents.end(), body) != kParents.end(); }

/// The joint, its children and its closing brace. @param order  gets the bodies as the hierarchy names them
void write_joint(const Character& character, int body, int depth, std::string& out, std::vector<int>& order) {
  order.push_back(body);
  const std::string indent(static_cast<std::size_t>(depth), '\t');
  out += indent + (body == 0 ? "ROOT " : "JOINT ") + std::string(kBodyNames[body]) + '\n' + indent + "{\n";
  // Readers disagree on whether a root's position replaces its OFFSET or adds to it: 0 suits both.
  out += indent + "\tOFFSET " + triple(body == 0 ? Vector3d::Zero() : character.joint_offset[body]) + '\n';
  out += indent + (body == 0 ? "\tCHANNELS 6 Xposition Yposition Zposition" : "\tCHANNELS 3") +
         " Zrotation Yrotation Xrotation\n";
  for (int child = 1; child < kBodies; ++child)
    if (kParents[child] == body) write_joint(character, child, depth + 1, out, order);
  if (!has_children(body))  // as long as the body's capsule, so that importers draw a bone
    out += indent + "\tEnd Site\n" + indent + "\t{\n" + indent + "\t\tOFFSET " +
           triple(character.capsule[body].b_B) + '\n' + indent + "\t}\n";
  out += indent + "}\n";
}

}  // namespace

std::string format_bvh(const motion::Clip& clip) {
  const Character character = motion::character_of(clip);
  const Vector3d rest = motion::rest_pelvis(clip);
  const Quaterniond q_YZ = exp_map(Vector3d(-0.5 * std::numbers::pi, 0, 0));  // from z up to y up
  std::string out = "HIERARCHY\n";
  std::vector<int> order;
  write_joint(character, kPelvis, 0, out, order);
  out += formatted("MOTION\nFrames: %d\nFrame Time: %.12f\n", clip.frames(), 1.0 / clip.fps);
  PerBody<Vector3d> angles;
  angles.fill(Vector3d::Zero());
  const auto rotations = motion::joint_rotations(clip);
  for (int t = 0; t < clip.frames(); ++t) {
    out += triple(q_YZ * (clip.trans[t] + rest));
    for (const int body : order) {
      const Quaterniond q = body == kPelvis ? q_YZ * rotations[t][body] : rotations[t][body];
      angles[body] = zyx_angles(q.toRotationMatrix(), angles[body]);
      out += ' ' + triple(angles[body]);
    }
    out += '\n';
  }
  return out;
}

void write_bvh(const std::filesystem::path& path, const motion::Clip& clip) {
  write_file_atomically(path, format_bvh(clip));
}

}  // namespace mimicx::import
