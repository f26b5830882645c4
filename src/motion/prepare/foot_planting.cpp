#include "motion/prepare/foot_planting.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "character/joint_range.h"
#include "core/so3.h"
#include "core/units.h"
#include "motion/prepare/stance.h"

namespace mimicx::motion {
namespace {

constexpr double kSigmaHeight = 0.001;   ///< m, of a standing point
constexpr double kSigmaSlip = 0.0006;    ///< m per frame, of a standing point
constexpr double kSigmaDepth = 0.0005;   ///< m, of a point below the floor
constexpr double kSigmaSide = 0.002;     ///< m, of a point in the side of a box
constexpr double kLandingSpeed = 0.75;   ///< m/s over the floor
constexpr double kSigmaLanding = 0.003;  ///< m per frame, faster than that
constexpr double kResting = 0.01;  ///< m from the floor or a side: so far, what came into it is held on it
constexpr double kClearance = 0.02, kClearanceSpeed = 1.5;  ///< m of a swinging point, at m/s and above
constexpr double kSigmaClearance = 0.003;                   ///< m
constexpr double kLanding = 0.034, kSwinging = 0.1;  ///< s from a stance: a foot lands or leaves, it swings
constexpr int kSmoothed = 2;  ///< frames to either side over which a swinging point's speed is averaged
constexpr double kSigmaPlace = 0.02;           ///< m, of the pelvis
constexpr double kSigmaPlaceBend = 0.00025;    ///< m, second difference at 30 frames per second
constexpr double kSigmaLegTurn = 0.15;         ///< rad, of a joint
constexpr double kSigmaTurnBend = 0.01;        ///< rad, second difference at 30 frames per second
constexpr double kSigmaToeBend = 0.05;         ///< rad, the same of the toes
constexpr double kSigmaAside = 0.03;           ///< m, horizontal place of knees and ankles
constexpr double kSigmaRange = 0.1 * kDegree;  ///< of a joint beyond its range, less the margin
constexpr double kInsideRange = 0.2 * kDegree;
constexpr double kPlantedHeight = 0.003, kPlantedSlip = 0.001;  ///< m, m per frame: nothing to correct
constexpr int kPlantingIterations = 6;
constexpr double kLargestPlantingStep = 0.2,
                 kSmallestStep = 1e-4;  ///< m and rad, of one unknown in one iteration

/// Unknowns of a frame: place of the pelvis (3), then per leg hip (3), knee (1), ankle (3) and the toes'
/// bend (1).
constexpr int kPlace = 3, kLegUnknowns = 8, kUnknowns = kPlace + 2 * kLegUnknowns;
using Correction = Eigen::Matrix<double, kUnknowns, 1>;
using PointJacobian = Eigen::Matrix<double, 3, kUnknowns>;

/// A joint of a leg with its unknowns.
struct LegTurn {
  int body, first, count;
};
constexpr Array<LegTurn, 8> kLegTurns = {{{{kLeftHip, 3, 3},
                                           {kLeftKnee, 6, 1},
                                           {kLeftAnkle, 7, 3},
                                           {kLeftFoot, 10, 1},
                                           {kRightHip, 11, 3},
                                           {kRightKnee, 14, 1},
                                           {kRightAnkle, 15, 3},
                                           {kRightFoot, 18, 1}}}};

Vector3d axis_of(int body) { return is_hinge(body) ? hinge_axis(body) : Vector3d::UnitX(); }

ReferenceFrame corrected(const ReferenceFrame& frame, const Correction& c) {
  ReferenceFrame out = frame;
  out.p_root += c.head<kPlace>();
  for (const LegTurn& turn : kLegTurns) {
    const Vector3d by =
        turn.count == 3 ? Vector3d(c.segment<3>(turn.first)) : Vector3d(c[turn.first] * axis_of(turn.body));
    out.q[turn.body] = frame.q[turn.body] * exp_map(by);
  }
  return out;
}

/// d p / d c of a point that is fixed to a body of a leg. Turns are small: exp(c + δ) ≈ exp(c) exp(δ).
PointJacobian leg_jacobian(const BodyPoses& poses, int body, const Vector3d& p) {
  PointJacobian J = PointJacobian::Zero();
  J.leftCols<kPlace>().setIdentity();
  for (const LegTurn& turn : kLegTurns) {
    int above = body;
    while (above > turn.body) above = kParents[above];
    if (above != turn.body) continue;
    const Vector3d arm = p - poses.p_WB[turn.body];
    const Matrix3d R = poses.q_WB[turn.body].toRotationMatrix();
    if (turn.count == 1) J.col(turn.first) = (R * axis_of(turn.body)).cross(arm);
    for (int k = 0; turn.count == 3 && k < 3; ++k) J.col(turn.first + k) = R.col(k).cross(arm);
  }
  return J;
}

/// Normal equations of one iteration: blocks on the diagonal, of neighbours, and of the frames after them.
struct PlantingEquations {
  using Block = Eigen::Matrix<double, kUnknowns, kUnknowns>;
  PerFrame<Block> diagonal, next, second;
  Eigen::VectorXd rhs;

  explicit PlantingEquations(int frames)
      : diagonal(frames, Block::Zero()),
        next(frames, Block::Zero()),
        second(frames, Block::Zero()),
        rhs(Eigen::VectorXd::Zero(frames * kUnknowns)) {}

  auto right(int t) { return rhs.segment<kUnknowns>(t * kUnknowns); }

  /// A residual of one frame.
  void add(int t, const Eigen::RowVectorXd& J, double residual, double sigma) {
    const double weight = 1.0 / (sigma * sigma);
    diagonal[t] += weight * J.transpose() * J;
    right(t) -= weight * residual * J.transpose();
  }
  /// A residual of the difference of two neighbours: J' c' − J c.
  void add(int t, const Eigen::RowVectorXd& J, const Eigen::RowVectorXd& J_next, double residual,
           double sigma) {
    const double weight = 1.0 / (sigma * sigma);
    add(t, -J, residual, sigma);
    add(t + 1, J_next, residual, sigma);
    next[t] -= weight * J_next.transpose() * J;
  }
  /// Second differences of all unknowns.
  void add_bend(const PerFrame<Correction>& c, int t, const Correction& sigma) {
    const Correction weight = sigma.cwiseProduct(sigma).cwiseInverse();
    const Correction residual = weight.cwiseProduct(c[t] - 2.0 * c[t + 1] + c[t + 2]);
    const Array<double, 3> share = {1.0, -2.0, 1.0};
    for (int i = 0; i < 3; ++i) {
      right(t + i) -= share[i] * residual;
      diagonal[t + i].diagonal() += share[i] * share[i] * weight;
    }
    next[t].diagonal() -= 2.0 * weight;
    next[t + 1].diagonal() -= 2.0 * weight;
    second[t].diagonal() += weight;
  }

  Eigen::VectorXd solve() const {
    const int frames = diagonal.count();
    std::vector<Eigen::Triplet<double>> entries;  // the lower triangle
    const auto put = [&](int row, int column, const Block& block) {
      for (int j = 0; j < kUnknowns; ++j)
        for (int i = row == column ? j : 0; i < kUnknowns; ++i)
          if (block(i, j) != 0.0)
            entries.emplace_back(row * kUnknowns + i, column * kUnknowns + j, block(i, j));
    };
    for (int t = 0; t < frames; ++t) {
      put(t, t, diagonal[t]);
      if (t + 1 < frames) put(t + 1, t, next[t]);
      if (t + 2 < frames) put(t + 2, t, second[t]);
    }
    Eigen::SparseMatrix<double> A(rhs.size(), rhs.size());
    A.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> factor(
        A);
    return factor.solve(rhs);
  }
};

constexpr Array<int, 4> kKneesAndAnkles = {kLeftKnee, kLeftAnkle, kRightKnee, kRightAnkle};

/// Points of the legs with their derivatives.
struct Legs {
  BodyPoses poses;
  SolePositions sole;
  Array<PointJacobian, kFootPoints> sole_J;
  Array<Vector3d, kKneesAndAnkles.size()> joint;
  Array<PointJacobian, kKneesAndAnkles.size()> joint_J;
};

/// The legs' contact points that are none of the soles: of thighs, knees and insteps.
List<ContactPoint> other_leg_points(const Character& character) {
  List<ContactPoint> found;
  for (int k = kFootPoints; k < character.contact_points.count(); ++k)
    for (const LegTurn& turn : kLegTurns)
      if (turn.body == character.contact_points[k].body) found.push_back(character.contact_points[k]);
  return found;
}

Legs legs_of(const Character& character, const ReferenceFrame& frame) {
  Legs legs;
  legs.poses = forward_kinematics(character, frame.p_root, frame.q);
  const BodyPoses& poses = legs.poses;
  legs.sole = sole_positions(character, poses);
  for (int k = 0; k < kFootPoints; ++k)
    legs.sole_J[k] = leg_jacobian(poses, character.contact_points[k].body, legs.sole[k]);
  for (std::size_t k = 0; k < kKneesAndAnkles.size(); ++k) {
    const int body = kKneesAndAnkles[k];
    legs.joint[k] = poses.p_WB[body];
    legs.joint_J[k] = leg_jacobian(poses, body, legs.joint[k]);
  }
  return legs;
}

/// The same size for all unknowns of a kind.
Correction sizes(double place, double turn) {
  Correction out = Correction::Constant(turn);
  out.head<kPlace>().setConstant(place);
  return out;
}

/// Joints of the legs stay inside their ranges.
void add_ranges(const Character& character, const ReferenceFrame& corrected, int t,
                PlantingEquations& equations) {
  for (const LegTurn& turn : kLegTurns) {
    const RangeDistance range = range_distance(character.joint[turn.body], turn.body, corrected.q[turn.body]);
    if (range.excess <= -kInsideRange) continue;
    Correction J = Correction::Zero();
    if (turn.count == 3)
      J.segment<3>(turn.first) = range.slope;
    else
      J[turn.first] = range.slope.dot(axis_of(turn.body));
    equations.add(t, J.transpose(), range.excess + kInsideRange, kSigmaRange);
  }
}

/// Time from every frame to the nearest one in which a point of the foot stands, s. [frames][left, right]
PerFrame<Array<double, 2>> times_to_stance(const PerFrame<Stance>& stance, double fps) {
  const int frames = stance.count();
  PerFrame<Array<double, 2>> out(frames, {1e9, 1e9});
  for (int t = 0; t < frames; ++t)
    for (int side = 0; side < 2; ++side) {
      if (t > 0) out[t][side] = out[t - 1][side] + 1.0 / fps;
      for (int k = 0; k < kPointsPerFoot; ++k)
        if (stance[t][side * kPointsPerFoot + k]) out[t][side] = 0.0;
    }
  for (int t = frames - 2; t >= 0; --t)
    for (int side = 0; side < 2; ++side) out[t][side] = std::min(out[t][side], out[t + 1][side] + 1.0 / fps);
  return out;
}

/// Heights that the points of the soles keep at least, m: 0 of standing points; a swinging one keeps a
/// clearance in proportion to its speed over the floor, up to kClearance. A foot that is about to land or has
/// just left keeps none: it would land a frame late and leave a frame early.
PerFrame<Array<double, kFootPoints>> clearances(const PerFrame<Stance>& stance, const Reference& reference) {
  const int frames = reference.size();
  PerFrame<SolePositions> p;
  for (const BodyPoses& frame : reference.poses) p.push_back(sole_positions(reference.character, frame));
  const auto away = times_to_stance(stance, reference.fps);
  PerFrame<Array<double, kFootPoints>> out(frames);
  for (int t = 0; t < frames; ++t)
    for (int k = 0; k < kFootPoints; ++k) {
      const int first = std::max(t - kSmoothed, 0), last = std::min(t + kSmoothed, frames - 1);
      double path = 0.0;
      for (int i = first; i < last; ++i) path += (p[i + 1][k] - p[i][k]).head<2>().norm();
      const double speed = path * reference.fps / std::max(last - first, 1);
      const double swings = (away[t][2 * k / kFootPoints] - kLanding) / (kSwinging - kLanding);
      out[t][k] = kClearance * std::min(1.0, speed / kClearanceSpeed) * std::clamp(swings, 0.0, 1.0);
    }
  return out;
}

/// Whether a point of the soles comes down in the frame that ends at t, or within kLanding after it.
PerFrame<Stance> landings(const PerFrame<Stance>& stance, double fps) {
  const int frames = stance.count(), before = static_cast<int>(std::lround(kLanding * fps));
  PerFrame<Stance> out(frames);
  for (int k = 0; k < kFootPoints; ++k) {
    int until = before + 1;  // the point stands, frames
    for (int t = frames - 1; t >= 0; --t) {
      until = stance[t][k] ? 0 : until + 1;
      out[t][k] = until <= before && t > 0 && !stance[t - 1][k];
    }
  }
  return out;
}

/// What swinging points keep to. A point that lands brakes first: one that friction has to stop slides.
struct Swing {
  PerFrame<Array<double, kFootPoints>> clearance;
  PerFrame<Stance> lands;
};

/// Points that came into the ground in a step before. They are held on its surface, else every second step
/// would push them in again.
struct Held {
  PerFrame<List<bool>> down;                 ///< [frames][other_leg_points] below it
  PerFrame<Array<bool, kFootPoints>> aside;  ///< [frames] in the side of a box
};

/// @param others  other_leg_points
Eigen::VectorXd step_of(const PerFrame<Stance>& stance, const Reference& reference, const Swing& swing,
                        const PerFrame<Correction>& c, const List<ContactPoint>& others, Held& held) {
  const int frames = reference.size();
  const double rate = 900.0 / (reference.fps * reference.fps);
  const Correction size = sizes(kSigmaPlace, kSigmaLegTurn);
  Correction bend = sizes(kSigmaPlaceBend, kSigmaTurnBend);
  for (const LegTurn& turn : kLegTurns)
    if (turn.body == kLeftFoot || turn.body == kRightFoot) bend[turn.first] = kSigmaToeBend;
  bend *= rate;
  PlantingEquations equations(frames);
  Legs before;
  for (int t = 0; t < frames; ++t) {
    const ReferenceFrame frame = corrected(reference.frames[t], c[t]);
    const Legs now = legs_of(reference.character, frame);
    add_ranges(reference.character, frame, t, equations);
    for (int i = 0; i < kUnknowns; ++i) equations.add(t, Correction::Unit(i).transpose(), c[t][i], size[i]);
    if (t + 2 < frames) equations.add_bend(c, t, bend);
    for (std::size_t k = 0; k < kKneesAndAnkles.size(); ++k)
      for (int axis = 0; axis < 2; ++axis)
        equations.add(t, now.joint_J[k].row(axis),
                      (now.joint[k] - reference.poses[t].p_WB[kKneesAndAnkles[k]])[axis], kSigmaAside);
    for (int k = 0; k < kFootPoints; ++k) {
      const bool stands = stance[t][k];
      const Vector3d& p = now.sole[k];
      const double z = reference.scene.clearance(p);
      if (stands || z < 0.0) equations.add(t, now.sole_J[k].row(2), z, stands ? kSigmaHeight : kSigmaDepth);
      const double wanted = swing.clearance[t][k];
      if (z < wanted) equations.add(t, now.sole_J[k].row(2), z - wanted, kSigmaClearance);
      const WayOut out = reference.scene.way_out(p, kResting);
      held.aside[t][k] = out.depth > kResting || (held.aside[t][k] && out.depth > 0.0);
      if (held.aside[t][k])
        equations.add(t, -out.direction.transpose() * now.sole_J[k], out.depth - kResting, kSigmaSide);
      if (t == 0) continue;
      const Eigen::Vector2d way = (p - before.sole[k]).head<2>();
      const double excess = way.norm() - kLandingSpeed / reference.fps;
      if (swing.lands[t][k] && excess > 0.0) {
        const Eigen::RowVector2d along = way.normalized().transpose();
        equations.add(t - 1, along * before.sole_J[k].topRows<2>(), along * now.sole_J[k].topRows<2>(),
                      excess, kSigmaLanding);
      }
      if (!stands || !stance[t - 1][k]) continue;
      for (int axis = 0; axis < 2; ++axis)
        equations.add(t - 1, before.sole_J[k].row(axis), now.sole_J[k].row(axis), way[axis], kSigmaSlip);
    }
    for (int k = 0; k < others.count(); ++k) {
      const Vector3d p = lowest_position(others[k], now.poses);
      const double z = reference.scene.clearance(p);
      held.down[t][k] = z < 0.0 || (held.down[t][k] && z < kResting);
      if (held.down[t][k])
        equations.add(t, leg_jacobian(now.poses, others[k].body, p).row(2), z, kSigmaDepth);
    }
    before = now;
  }
  return equations.solve();
}

/// Whether every standing point is on the floor and stays where it is, and no point is in the side of a box.
bool is_planted(const PerFrame<Stance>& stance, const Reference& reference) {
  SolePositions before;
  for (int t = 0; t < reference.size(); ++t) {
    const SolePositions p = sole_positions(reference.character, reference.poses[t]);
    for (int k = 0; k < kFootPoints; ++k) {
      if (reference.scene.way_out(p[k], 0.0).depth > 0.0) return false;
      if (!stance[t][k]) continue;
      if (std::abs(reference.scene.clearance(p[k])) > kPlantedHeight) return false;
      if (t > 0 && stance[t - 1][k] && (p[k] - before[k]).head<2>().norm() > kPlantedSlip) return false;
    }
    before = p;
  }
  return true;
}

}  // namespace

double plant_feet(const PerFrame<Stance>& stance, Reference& reference) {
  if (is_planted(stance, reference)) return 0.0;
  const int frames = reference.size();
  const Swing swing{clearances(stance, reference), landings(stance, reference.fps)};
  PerFrame<Correction> c(frames, Correction::Zero());
  const List<ContactPoint> others = other_leg_points(reference.character);
  Held held{PerFrame<List<bool>>(frames, List<bool>(others.size(), false)),
            PerFrame<Array<bool, kFootPoints>>(frames)};
  for (int iteration = 0; iteration < kPlantingIterations; ++iteration) {
    const Eigen::VectorXd step = step_of(stance, reference, swing, c, others, held);
    const double largest = step.cwiseAbs().maxCoeff();
    const double scale = std::min(1.0, kLargestPlantingStep / std::max(largest, kSmallestStep));
    for (int t = 0; t < frames; ++t) c[t] += scale * step.segment<kUnknowns>(t * kUnknowns);
    if (largest < kSmallestStep) break;
  }
  double moved = 0.0;
  for (int t = 0; t < frames; ++t) {
    reference.frames[t] = corrected(reference.frames[t], c[t]);
    const BodyPoses now =
        forward_kinematics(reference.character, reference.frames[t].p_root, reference.frames[t].q);
    for (int body = 0; body < kBodies; ++body)
      moved = std::max(moved, (now.p_WB[body] - reference.poses[t].p_WB[body]).norm());
    reference.poses[t] = now;
  }
  return moved;
}

}  // namespace mimicx::motion
