#include "judge/forces/planar_moments.h"

#include <algorithm>
#include <cmath>

#include "audit/load_sharing/load_sharing.h"
#include "core/decompositions.h"
#include "core/units.h"

namespace mimicx::judge {
namespace {

constexpr int kWindow = 7;          ///< frames of a cubic
constexpr double kPressing = 10.0;  ///< N
/// Of the left side; a body of the right side follows it.
constexpr Array<int, 4> kLegJoints = {kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot};

/// A segment between two joints as a point mass.
struct Segment {
  int upper, lower;     ///< places of its joints in kLegJoints
  double along, share;  ///< of its centre of mass, from the upper joint; of the body's mass
};
/// Foot, shank, thigh.
constexpr Segment kSegments[] = {{2, 3, 0.5, 0.0137}, {1, 2, 0.44, 0.0433}, {0, 1, 0.41, 0.1416}};

/// Second derivative at place `at` of the cubic that fits kWindow points best, per frame².
Vector3d curvature(const Vector3d* points, int at) {
  Eigen::MatrixXd powers(kWindow, 4);
  for (int i = 0; i < kWindow; ++i) {
    const double x = i - at;
    powers.row(i) << 1.0, x, x * x, x * x * x;
  }
  // The coefficients of the cubic are (PᵀP)⁻¹Pᵀ times the points.
  const Eigen::VectorXd weight =
      powers * solve_symmetric(powers.transpose() * powers, Eigen::Vector4d::UnitZ());
  Vector3d bend = Vector3d::Zero();
  for (int i = 0; i < kWindow; ++i) bend += 2.0 * weight[i] * points[i];
  return bend;
}

/// Central differences, one-sided at the ends.
PerFrame<Vector3d> slopes(const PerFrame<Vector3d>& points) {
  PerFrame<Vector3d> out(points.count(), Vector3d::Zero());
  const int last = points.count() - 1;
  for (int t = 0; t <= last && last > 0; ++t) {
    const int before = std::max(0, t - 1), after = std::min(last, t + 1);
    out[t] = (points[after] - points[before]) / (after - before);
  }
  return out;
}

}  // namespace

PerFrame<Vector3d> smooth_accelerations(const PerFrame<Vector3d>& points, double fps) {
  if (points.count() < kWindow) {
    PerFrame<Vector3d> out = slopes(slopes(points));
    for (Vector3d& a : out) a *= fps * fps;
    return out;
  }
  PerFrame<Vector3d> out;
  for (int t = 0; t < points.count(); ++t) {
    const int first = std::clamp(t - kWindow / 2, 0, points.count() - kWindow);
    out.push_back(fps * fps * curvature(&points[first], t - first));
  }
  return out;
}

PerFrame<LegMoments> planar_moments(const PressedLegs& legs) {
  PerFrame<LegMoments> moments(legs.joints.count());
  for (int side = 0; side < 2; ++side) {
    const auto joint = [&](int t, int place) { return legs.joints[t][kLegJoints[place] + side]; };
    Array<PerFrame<Vector3d>, 3> center, needed;
    for (int q = 0; q < 3; ++q) {
      const Segment& segment = kSegments[q];
      for (int t = 0; t < legs.joints.count(); ++t)
        center[q].push_back(joint(t, segment.upper) +
                            segment.along * (joint(t, segment.lower) - joint(t, segment.upper)));
      needed[q] = smooth_accelerations(center[q], legs.fps);
    }
    for (int t = 0; t < legs.joints.count(); ++t)
      for (int j = 0; j < 3; ++j) {
        const Vector3d about = joint(t, kSegments[j].upper);
        Vector3d moment = Vector3d::Zero();
        Vector3d pressure = legs.pressure[t][side];
        if (!std::isfinite(pressure.z())) pressure.z() = 0.0;
        if (pressure.allFinite() && legs.force[t][side].z() > kPressing)
          moment += (pressure - about).cross(legs.force[t][side]);
        for (int q = 0; q <= j; ++q)
          moment -=
              (center[q][t] - about)
                  .cross(kSegments[q].share * legs.mass * (needed[q][t] + kGravity * Vector3d::UnitZ()));
        moments[t][side][j] = -moment.dot(legs.axes[t].col(1)) / legs.mass;
      }
  }
  return moments;
}

PerFrame<LegMoments> recorded_moments(const audit::SimulatedFrames& motion) {
  PerFrame<LegMoments> moments(static_cast<int>(motion.frames.size()));
  for (int t = 0; t < moments.count(); ++t) {
    const motion::ReferenceFrame& frame = motion.frames[static_cast<std::size_t>(t)];
    const BodyPoses poses = forward_kinematics(motion.character, frame.p_root, frame.q);
    const Vector3d left = audit::heading_axes(poses.p_WB).col(1);
    for (int side = 0; side < 2; ++side)
      for (int j = 0; j < 3; ++j) {
        const int body = kLegJoints[2 - j] + side;
        moments[t][side][j] =
            (poses.q_WB[body] * motion.forces[static_cast<std::size_t>(t)].joint_torque[body]).dot(left) /
            motion.character.total_mass();
      }
  }
  return moments;
}

}  // namespace mimicx::judge
