#include "motion/prepare/arm_separation.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/closest_points.h"

namespace mimicx::motion {
namespace {

constexpr double kSigmaOverlap = 0.003;  ///< m
constexpr double kSigmaTurn = 0.5;       ///< rad
constexpr double kSigmaBend = 0.02;      ///< rad, second difference at 30 frames per second
constexpr int kIterations = 40;
constexpr double kLargestStep = 0.2;         ///< rad, of one unknown in one iteration
constexpr int kHalvings = 8;                 ///< of a step that does not reduce the sum of squares
constexpr double kSmallestTurn = 1e-4;       ///< rad: below, it has converged
constexpr double kOverlapGrows = 1.0 / 3.0;  ///< s
constexpr double kTouching = 1e-6;           ///< m: axes that cross have no direction apart

/// Unknowns of a frame: shoulder (3) and elbow (1) of the left arm, then of the right one.
constexpr int kArmUnknowns = 8;
using Turns = Eigen::Matrix<double, kArmUnknowns, 1>;
struct Turn {
  int body, first, count;
};
constexpr Array<Turn, 4> kTurns = {
    {{{kLeftShoulder, 0, 3}, {kLeftElbow, 3, 1}, {kRightShoulder, 4, 3}, {kRightElbow, 7, 1}}}};

bool is_of_arm(int body) { return kLimbOf[body] >= 3; }

PerBody<Quaterniond> turned(const PerBody<Quaterniond>& q, const Turns& c) {
  PerBody<Quaterniond> out = q;
  for (const Turn& turn : kTurns) {
    const Vector3d by = turn.count == 3 ? Vector3d(c.segment<3>(turn.first))
                                        : Vector3d(c[turn.first] * hinge_axis(turn.body));
    out[turn.body] = q[turn.body] * exp_map(by);
  }
  return out;
}

/// Two capsules that overlap by more than is allowed.
struct Overlap {
  double excess;  ///< m
  Turns slope;    ///< of it, by the turns of the frame
};

/// d p / d c of a point that is fixed to a body, [3][8]. Turns are small: exp(c + δ) ≈ exp(c) exp(δ).
Eigen::Matrix<double, 3, kArmUnknowns> point_jacobian(const BodyPoses& poses, int body, const Vector3d& p) {
  Eigen::Matrix<double, 3, kArmUnknowns> J = Eigen::Matrix<double, 3, kArmUnknowns>::Zero();
  for (const Turn& turn : kTurns) {
    int above = body;
    while (above > turn.body) above = kParents[above];
    if (above != turn.body) continue;
    const Vector3d arm = p - poses.p_WB[turn.body];
    const Matrix3d R = poses.q_WB[turn.body].toRotationMatrix();
    if (turn.count == 1) J.col(turn.first) = (R * hinge_axis(turn.body)).cross(arm);
    for (int k = 0; turn.count == 3 && k < 3; ++k) J.col(turn.first + k) = R.col(k).cross(arm);
  }
  return J;
}

List<Overlap> find_overlaps(const Character& character, const BodyPoses& poses, double allowed) {
  List<Overlap> found;
  for (const auto& [a, b] : character.self_pairs) {
    if (!is_of_arm(a) && !is_of_arm(b)) continue;
    const SegmentPair near = closest_points(character, poses, a, b);
    const Vector3d apart = near.a - near.b;
    const double excess = character.capsule[a].radius + character.capsule[b].radius - apart.norm() - allowed;
    if (excess <= 0.0 || apart.norm() < kTouching) continue;
    const Vector3d n = apart.normalized();
    found.push_back(
        {excess, -(point_jacobian(poses, a, near.a) - point_jacobian(poses, b, near.b)).transpose() * n});
  }
  return found;
}

/// The normal equations of one iteration, entry by entry.
struct Equations {
  using Matrix = Eigen::SparseMatrix<double>;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd rhs;

  explicit Equations(int frames) : rhs(Eigen::VectorXd::Zero(frames * kArmUnknowns)) {}

  /// One residual of the same unknown in neighbouring frames: Σ_i share_i c_{t+i}, with a weight.
  void add(const PerFrame<Turns>& c, int t, const std::vector<double>& shares, double weight) {
    for (int k = 0; k < kArmUnknowns; ++k) {
      double residual = 0.0;
      for (int i = 0; i < static_cast<int>(shares.size()); ++i)
        residual += shares[static_cast<std::size_t>(i)] * c[t + i][k];
      for (int i = 0; i < static_cast<int>(shares.size()); ++i) {
        const double si = weight * shares[static_cast<std::size_t>(i)];
        rhs[(t + i) * kArmUnknowns + k] -= si * residual;
        for (int j = 0; j < static_cast<int>(shares.size()); ++j)
          entries.emplace_back((t + i) * kArmUnknowns + k, (t + j) * kArmUnknowns + k,
                               si * shares[static_cast<std::size_t>(j)]);
      }
    }
  }
  void add(int t, const Overlap& overlap) {
    const double weight = 1.0 / (kSigmaOverlap * kSigmaOverlap);
    rhs.segment<kArmUnknowns>(t * kArmUnknowns) -= weight * overlap.excess * overlap.slope;
    for (int i = 0; i < kArmUnknowns; ++i)
      for (int j = 0; j < kArmUnknowns; ++j)
        entries.emplace_back(t * kArmUnknowns + i, t * kArmUnknowns + j,
                             weight * overlap.slope[i] * overlap.slope[j]);
  }
  Eigen::VectorXd solve() const {
    Matrix A(rhs.size(), rhs.size());
    A.setFromTriplets(entries.begin(), entries.end());
    return Eigen::SimplicialLDLT<Matrix>(A).solve(rhs);
  }
};

BodyPoses poses_with(const Reference& reference, int t, const Turns& c) {
  const ReferenceFrame& frame = reference.frames[t];
  return forward_kinematics(reference.character, frame.p_root, turned(frame.q, c));
}

/// What the turns shall make small: their own size, their second differences and the excess of overlaps.
double sum_of_squares(const Reference& reference, const PerFrame<Turns>& c, double bend) {
  double sum = 0.0;
  for (int t = 0; t < reference.size(); ++t) {
    sum += c[t].squaredNorm() / (kSigmaTurn * kSigmaTurn);
    if (t + 2 < reference.size()) sum += (c[t] - 2.0 * c[t + 1] + c[t + 2]).squaredNorm() / (bend * bend);
    for (const Overlap& overlap : find_overlaps(reference.character, poses_with(reference, t, c[t]),
                                                allowed_overlap(t, reference.fps)))
      sum += overlap.excess * overlap.excess / (kSigmaOverlap * kSigmaOverlap);
  }
  return sum;
}

/// Gauss–Newton. An overlap counts while it is there, so a whole step may jump far out of it, and the next
/// one back into it: steps are halved until the sum of squares falls.
PerFrame<Turns> solve_turns(const Reference& reference) {
  const int frames = reference.size();
  const double bend = kSigmaBend * 900.0 / (reference.fps * reference.fps);
  PerFrame<Turns> c(reference.frames.size(), Turns::Zero());
  double sum = sum_of_squares(reference, c, bend);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Equations equations(frames);
    for (int t = 0; t < frames; ++t) {
      equations.add(c, t, {1.0}, 1.0 / (kSigmaTurn * kSigmaTurn));
      if (t + 2 < frames) equations.add(c, t, {1.0, -2.0, 1.0}, 1.0 / (bend * bend));
      for (const Overlap& overlap : find_overlaps(reference.character, poses_with(reference, t, c[t]),
                                                  allowed_overlap(t, reference.fps)))
        equations.add(t, overlap);
    }
    const Eigen::VectorXd step = equations.solve();
    const double largest = step.cwiseAbs().maxCoeff(), before = sum;
    double scale = std::min(1.0, kLargestStep / std::max(largest, kSmallestTurn));
    for (int halving = 0; halving <= kHalvings && sum >= before; ++halving, scale *= 0.5) {
      PerFrame<Turns> next = c;
      for (int t = 0; t < frames; ++t) next[t] += scale * step.segment<kArmUnknowns>(t * kArmUnknowns);
      const double reached = sum_of_squares(reference, next, bend);
      if (reached < before) c = next, sum = reached;
    }
    if (largest < kSmallestTurn || sum >= before) break;
  }
  return c;
}

bool has_overlap(const Reference& reference) {
  for (int t = 0; t < reference.size(); ++t)
    if (!find_overlaps(reference.character, reference.poses[t], allowed_overlap(t, reference.fps)).empty())
      return true;
  return false;
}

}  // namespace

double allowed_overlap(int frame, double fps) {
  return kAllowedOverlap * std::min(1.0, frame / (kOverlapGrows * fps));
}

double separate_arms(Reference& reference) {
  if (!has_overlap(reference)) return 0.0;
  const PerFrame<Turns> c = solve_turns(reference);
  double moved = 0.0;
  for (int t = 0; t < reference.size(); ++t) {
    const BodyPoses now = poses_with(reference, t, c[t]);
    for (int body = 0; body < kBodies; ++body)
      moved = std::max(moved, (now.p_WB[body] - reference.poses[t].p_WB[body]).norm());
    reference.frames[t].q = turned(reference.frames[t].q, c[t]);
    reference.poses[t] = now;
  }
  return moved;
}

}  // namespace mimicx::motion
