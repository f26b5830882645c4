#include "synth/noise/occlusion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mimicx::synth {
namespace {

/// Part of a line, in parts of the segment.
struct Part {
  double from = std::numeric_limits<double>::infinity();
  double to = -std::numeric_limits<double>::infinity();

  void widen(const Part& other) { from = std::min(from, other.from), to = std::max(to, other.to); }
};

/// Where square·x² + 2·half·x + rest ≤ 0, for square > 0; empty where nowhere.
Part between_roots(double square, double half, double rest) {
  const double discriminant = half * half - square * rest;
  if (discriminant < 0.0) return {};
  const double root = std::sqrt(discriminant);
  return {(-half - root) / square, (-half + root) / square};
}

Part inside_sphere(const Vector3d& start, const Vector3d& along, const Vector3d& centre, double radius) {
  const Vector3d from_centre = start - centre;
  return between_roots(along.squaredNorm(), along.dot(from_centre),
                       from_centre.squaredNorm() - radius * radius);
}

/// Inside the cylinder about the axis from a to b, between the planes of its ends.
Part inside_cylinder(const Vector3d& start, const Vector3d& along, const Vector3d& a, const Vector3d& b,
                     double radius) {
  const double length = (b - a).norm();
  if (length < 1e-9) return {};
  const Vector3d axis = (b - a) / length, from_a = start - a;
  const double speed = along.dot(axis), place = from_a.dot(axis);
  Part part{0.0, 1.0};
  const Vector3d across = along - speed * axis, offset = from_a - place * axis;
  if (across.squaredNorm() > 1e-18) {
    part = between_roots(across.squaredNorm(), across.dot(offset), offset.squaredNorm() - radius * radius);
  } else if (offset.norm() > radius) {
    return {};
  }
  if (std::abs(speed) > 1e-12) {
    const double one = -place / speed, other = (length - place) / speed;
    part = {std::max(part.from, std::min(one, other)), std::min(part.to, std::max(one, other))};
  } else if (place < 0.0 || place > length) {
    return {};
  }
  return part.from <= part.to ? part : Part{};
}

}  // namespace

double length_inside(const Vector3d& eye, const Vector3d& point, const Vector3d& a, const Vector3d& b,
                     double radius) {
  const Vector3d along = point - eye;
  Part part = inside_cylinder(eye, along, a, b, radius);  // a capsule is convex: one part of the line
  part.widen(inside_sphere(eye, along, a, radius));
  part.widen(inside_sphere(eye, along, b, radius));
  const double share = std::min(part.to, 1.0) - std::max(part.from, 0.0);
  return std::max(share, 0.0) * along.norm();
}

bool is_hidden(const Character& character, const BodyPoses& poses, const Vector3d& eye,
               const Vector3d& point) {
  return std::any_of(character.capsule.begin(), character.capsule.end(), [&](const Capsule& capsule) {
    const auto in_world = [&](const Vector3d& p_B) {
      return Vector3d(poses.p_WB[capsule.body] + poses.q_WB[capsule.body] * p_B);
    };
    return length_inside(eye, point, in_world(capsule.a_B), in_world(capsule.b_B), capsule.radius) >
           kHidingDepth * capsule.radius;
  });
}

}  // namespace mimicx::synth
