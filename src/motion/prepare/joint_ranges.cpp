#include "motion/prepare/joint_ranges.h"

#include <cmath>

#include "character/joint_range.h"
#include "core/units.h"
#include "motion/prepare/smooth_correction.h"

namespace mimicx::motion {
namespace {

constexpr double kRangeMargin = 0.3 * kDegree;  ///< d₀
constexpr double kSigmaBeyond = 0.1 * kDegree;  ///< σ_d
constexpr CorrectionSigmas kRangeSigmas = {15.0 * kDegree, 1.0 * kDegree, 0.3, 1e-5, 10};
constexpr double kSurroundings = 1.0 / 3.0;  ///< s before and after frames beyond the range

/// A joint over a stretch of frames.
struct JointOverStretch {
  const Reference& reference;
  int body;
  FrameSpan stretch;

  /// The distance of the joint, turned by c. Turns are small: exp(c + δ) ≈ exp(c) exp(δ).
  RangeDistance distance(int i, const Vector3d& c) const {
    const Quaterniond q = reference.frames[stretch.first + i].q[body] * exp_map(c);
    RangeDistance d = range_distance(reference.character.joint[body], body, q);
    if (is_hinge(body)) d.slope = hinge_axis(body) * hinge_axis(body).dot(d.slope);
    return d;
  }
};

/// The smallest further turn that brings a joint to the surface of its range, or inside.
Vector3d onto_surface(const JointOverStretch& joint, int i, Vector3d c) {
  constexpr int kNewton = 20;
  for (int k = 0; k < kNewton; ++k) {
    const RangeDistance d = joint.distance(i, c);
    if (d.excess <= 0.0) break;
    const Vector3d back = -(d.excess + 1e-9) / d.slope.squaredNorm() * d.slope;
    c = log_map(exp_map(c) * exp_map(back));
  }
  return c;
}

List<Vector3d> turns_into_range(const JointOverStretch& joint) {
  const auto distances = [&](const List<Vector3d>& c, CorrectionEquations<3>& equations) {
    for (int i = 0; i < c.count(); ++i) {
      const RangeDistance d = joint.distance(i, c[i]);
      if (d.excess > -kRangeMargin) equations.add(i, d.slope, d.excess + kRangeMargin, kSigmaBeyond);
    }
  };
  const Reference& reference = joint.reference;
  List<Vector3d> c =
      smooth_correction<3>(joint.stretch, reference.size(), reference.fps, kRangeSigmas, distances).c;
  for (int i = 0; i < c.count(); ++i) c[i] = onto_surface(joint, i, c[i]);
  return c;
}

/// Turns a body by its joint. Bodies below it keep their orientations in the world, unless their joints are
/// hinges.
void turn_alone(int body, const Vector3d& c, PerBody<Quaterniond>& q) {
  const Quaterniond turn = exp_map(c);
  q[body] = (q[body] * turn).normalized();
  for (int child = body + 1; child < kBodies; ++child)
    if (kParents[child] == body && !is_hinge(child)) q[child] = (turn.conjugate() * q[child]).normalized();
}

}  // namespace

RangeReport turn_into_ranges(Reference& reference) {
  RangeReport report;
  const int frames = reference.size(), around = static_cast<int>(std::ceil(kSurroundings * reference.fps));
  const auto excess = [&](int t, int body) {
    return range_distance(reference.character.joint[body], body, reference.frames[t].q[body]).excess;
  };
  for (int t = 0; t < frames; ++t) {
    bool any = false;
    for (int body = 1; body < kBodies; ++body) {
      const double beyond = excess(t, body);
      any = any || beyond > 0.0;
      if (beyond > report.farthest) report.farthest = beyond, report.body = body;
    }
    report.frames += any ? 1 : 0;
  }
  if (report.frames == 0) return report;
  for (int body = 1; body < kBodies; ++body) {
    PerFrame<bool> beyond;
    for (int t = 0; t < frames; ++t) beyond.push_back(excess(t, body) > 0.0);
    for (const FrameSpan& stretch : stretches_around(beyond, around)) {
      const List<Vector3d> c = turns_into_range({reference, body, stretch});
      for (int i = 0; i < c.count(); ++i) turn_alone(body, c[i], reference.frames[stretch.first + i].q);
    }
  }
  return report;
}

}  // namespace mimicx::motion
