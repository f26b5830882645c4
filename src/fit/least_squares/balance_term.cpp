#include "fit/least_squares/balance_term.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "motion/surface_points.h"

namespace mimicx::fit {
namespace {

constexpr double kAccelerationWindow = 0.1;   ///< s to either side
constexpr double kOtherSupport = 0.05;        ///< m; other points this low may bear weight
constexpr double kLeastPush = 0.5;            ///< share of the weight; with less load the body flies
constexpr double kSpread = 0.02;              ///< m, σ of the point where the support has no size
constexpr double kCornersToArea = 1.0 / 3.0;  ///< variance of a rectangle over that of its corners
constexpr double kKernel = 2.0;               ///< in σ; the model of point masses is approximate
constexpr int kFewestPoints = 3;

using Plane = Eigen::Vector2d;
using PlaneJacobian = Eigen::Matrix<double, 2, kFrameUnknowns>;

/// All surface points except those of the feet.
std::vector<motion::SurfacePoint> points_beside_feet(const Character& character) {
  std::vector<motion::SurfacePoint> points = motion::surface_points(character);
  std::erase_if(points, [](const motion::SurfacePoint& p) {
    return p.body == kLeftFoot || p.body == kRightFoot || p.body == kLeftAnkle || p.body == kRightAnkle;
  });
  return points;
}

/// Derivative of the horizontal position of the centre of mass.
PlaneJacobian centre_jacobian(const Character& character, const FrameKinematics& k) {
  PlaneJacobian J = PlaneJacobian::Zero();
  const double total = character.total_mass();
  for (int b = 0; b < kBodies; ++b) {
    const Vector3d p = k.poses.p_WB[b] + k.R[b] * character.com_B[b];
    J += character.mass[b] / total * point_jacobian(k, b, p).topRows<2>();
  }
  return J;
}

/// The points that stand in a frame: their horizontal positions, the height of the ground under them.
struct Support {
  int points = 0;
  Plane middle = Plane::Zero();
  double height = 0.0;                             ///< of the ground under them, m
  PlaneJacobian by_frame = PlaneJacobian::Zero();  ///< of the middle
  Eigen::Matrix2d spread = kSpread * kSpread * Eigen::Matrix2d::Identity();
};

Support support_of(const FitProblem& problem, const FrameKinematics& k, const FootPositions& feet,
                   const Array<bool, kFootPoints>& stands) {
  Support s;
  for (int i = 0; i < kFootPoints; ++i) {
    if (!stands[i]) continue;
    ++s.points;
    s.middle += feet[i].head<2>();
    s.height += problem.scene.height_under(sole_middle(feet, i));
    s.by_frame += point_jacobian(k, problem.foot_points[i].body, feet[i]).topRows<2>();
  }
  if (s.points == 0) return s;
  const double share = 1.0 / s.points;
  s.middle *= share;
  s.height *= share;
  s.by_frame *= share;
  for (int i = 0; i < kFootPoints; ++i) {
    const Plane d = feet[i].head<2>() - s.middle;
    if (stands[i]) s.spread += kCornersToArea * share * d * d.transpose();
  }
  return s;
}

}  // namespace

void add_balance(const FitProblem& problem, const Character& character,
                 const PerFrame<FrameKinematics>& motion, const PerFrame<FootPositions>& feet,
                 const Contacts& contacts, BorderedBand& system) {
  if (problem.config.balance_frames <= 0.0) return;
  const double share = kReferenceFps / (problem.fps * problem.config.balance_frames);
  const int window = std::max(1, static_cast<int>(std::round(kAccelerationWindow * problem.fps)));
  const double seconds = window / problem.fps;
  const std::vector<motion::SurfacePoint> others = points_beside_feet(character);
  PerFrame<Vector3d> c;
  for (const FrameKinematics& k : motion) c.push_back(center_of_mass(character, k.poses));
  for (int t = window; t + window < problem.frames(); ++t) {
    const Support support = support_of(problem, motion[t], feet[t], contacts[t]);
    const Vector3d a = (c[t + window] - 2.0 * c[t] + c[t - window]) / (seconds * seconds);
    if (support.points < kFewestPoints || a.z() < (kLeastPush - 1.0) * kGravity ||
        motion::lowest_height(others, motion[t].poses, problem.scene) < kOtherSupport)
      continue;
    const Plane zmp = c[t].head<2>() - (c[t].z() - support.height) / (kGravity + a.z()) * a.head<2>();
    const Plane r = zmp - support.middle;
    const Eigen::Matrix2d precision = support.spread.inverse();
    const double weight = share / (1.0 + r.dot(precision * r) / (kKernel * kKernel));
    const PlaneJacobian J = centre_jacobian(character, motion[t]) - support.by_frame;
    system.diagonal[t].noalias() += weight * J.transpose() * precision * J;
    system.rhs[t].noalias() -= weight * J.transpose() * (precision * r);
  }
}

}  // namespace mimicx::fit
