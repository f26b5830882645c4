#include "motion/prepare/self_passage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/elementary.h"
#include "core/units.h"
#include "motion/closest_points.h"
#include "motion/keypoint_names.h"
#include "motion/prepare/feet.h"
#include "motion/prepare/smooth_correction.h"

namespace mimicx::motion {
namespace {

constexpr double kKeptInTrunk = 0.02;  ///< m, f₀ where the obstacle is the trunk or the head
constexpr double kKeptInLimb = 0.5;    ///< f₀ where it is a limb, in parts of the reach: legs pass close by
constexpr double kThrough = 0.4;       ///< of the reach: axes that stay farther apart glance off
constexpr double kGrazing = 0.3;       ///< least cosine of a way to the normal where it leads out
constexpr double kFlip = 70.0 * kDegree;                       ///< turn of the direction between two frames
constexpr double kSigmaDepthAside = 0.003, kSigmaSeen = 0.03;  ///< m
constexpr CorrectionSigmas kLimbSigmas = {0.5, 1.5 * kDegree, 0.2, 1e-3, 15};  ///< rad
constexpr double kBeforeAndAfter = 0.5;                                        ///< s
constexpr int kWaysAcross = 8;
constexpr int kMostPassages = 40;      ///< that are led around
constexpr int kFramesPerPassage = 15;  ///< of a long motion so many more: one in these frames
constexpr double kSigmaDetection = 0.02, kFarDetection = 0.1;  ///< heights of the box

/// Unknowns of a frame: root joint (3) and hinge (1) of the limb.
constexpr int kLimbUnknowns = 4;
using LimbTurns = Eigen::Matrix<double, kLimbUnknowns, 1>;
using LimbEquations = CorrectionEquations<kLimbUnknowns>;
using LimbJacobian = Eigen::Matrix<double, 3, kLimbUnknowns>;

/// A limb that can be turned: its root joint and its hinge.
struct TurnedLimb {
  int number, root, hinge, tip;  ///< tip: wrist or ankle
};
TurnedLimb limb_of(int number) {
  const int root = kLimbRoot[number];
  const auto child = [](int body) {
    return static_cast<int>(std::find(kParents.begin(), kParents.end(), body) - kParents.begin());
  };
  return {number, root, child(root), child(child(root))};
}

/// A limb inside another part of the body, over frames first … last, through which it passes.
struct Passage {
  int limb, obstacle, body;  ///< body: of the limb, which passes
  int first, last;
  Vector3d before, after;  ///< directions from the obstacle to the limb, obstacle's frame; 0 where unknown
};

/// Vector from the axis of the obstacle to that of a body, obstacle's frame, m.
Vector3d apart_of(const Reference& reference, const BodyPoses& poses, int body, int obstacle) {
  const SegmentPair near = closest_points(reference.character, poses, body, obstacle);
  return poses.q_WB[obstacle].conjugate() * (near.a - near.b);
}

double reach_of(const Character& character, int a, int b) {
  return character.capsule[a].radius + character.capsule[b].radius;
}

/// Whether a body passes through within one frame: its direction flips, and its straight way is deep inside.
bool flips(const Vector3d& from, const Vector3d& to, double reach) {
  if (angle_between(from, to) < kFlip) return false;
  const Vector3d way = to - from;
  const double share = std::clamp(-from.dot(way) / std::max(way.squaredNorm(), 1e-12), 0.0, 1.0);
  return (from + share * way).norm() < kThrough * reach;
}

/// The passages of a body through an obstacle.
void find_passages(const Reference& reference, int body, int obstacle, List<Passage>& found) {
  const double reach = reach_of(reference.character, body, obstacle);
  const int frames = reference.size();
  PerFrame<Vector3d> apart;
  for (const BodyPoses& poses : reference.poses) apart.push_back(apart_of(reference, poses, body, obstacle));
  const auto inside = [&](int t) { return t >= 0 && t < frames && apart[t].norm() < reach; };
  for (int t = 0; t + 1 < frames; ++t) {
    if (!flips(apart[t], apart[t + 1], reach)) continue;
    Passage p{kLimbOf[body], obstacle, body, t, t + 1, Vector3d::Zero(), Vector3d::Zero()};
    while (inside(p.first)) --p.first;
    while (inside(p.last)) ++p.last;
    if (p.first >= 0) p.before = apart[p.first].normalized();
    if (p.last < frames) p.after = apart[p.last].normalized();
    p.first = std::max(p.first, 0), p.last = std::min(p.last, frames - 1);
    if (p.before.isZero() && p.after.isZero()) continue;  // never outside: no side is right
    found.push_back(p);
    t = p.last;
  }
}

/// Limbs that may give way in a pair: any limb but the trunk; of two legs or arms both.
List<Passage> all_passages(const Reference& reference) {
  List<Passage> found;
  for (const auto& [a, b] : reference.character.self_pairs)
    for (const auto& [body, obstacle] : {std::pair{a, b}, std::pair{b, a}}) {
      const bool arm = kLimbOf[body] >= 3, other_is_arm = kLimbOf[obstacle] >= 3;
      if (kLimbOf[body] != 0 && (arm || !other_is_arm)) find_passages(reference, body, obstacle, found);
    }
  std::stable_sort(found.begin(), found.end(),
                   [](const Passage& a, const Passage& b) { return a.first < b.first; });
  return found;
}

/// The reference of one passage and the frames that may change.
struct Situation {
  const Reference& reference;
  Passage passage;
  TurnedLimb limb;
  FrameSpan stretch;
  std::vector<std::array<int, 2>> pairs;  ///< a body of the limb, one of the obstacle's

  PerBody<Quaterniond> turned(int i, const LimbTurns& c) const {
    PerBody<Quaterniond> q = reference.frames[stretch.first + i].q;
    q[limb.root] = q[limb.root] * exp_map(Vector3d(c.head<3>()));
    q[limb.hinge] = q[limb.hinge] * exp_map(Vector3d(c[3] * hinge_axis(limb.hinge)));
    return q;
  }
  BodyPoses poses(int i, const LimbTurns& c) const {
    return forward_kinematics(reference.character, reference.frames[stretch.first + i].p_root, turned(i, c));
  }
  /// d p / d c of a point of the limb. Turns are small: exp(c + δ) ≈ exp(c) exp(δ).
  LimbJacobian jacobian(const BodyPoses& at, int body, const Vector3d& p) const {
    LimbJacobian J = LimbJacobian::Zero();
    const Matrix3d R = at.q_WB[limb.root].toRotationMatrix();
    for (int k = 0; k < 3; ++k) J.col(k) = R.col(k).cross(p - at.p_WB[limb.root]);
    if (body != limb.root)
      J.col(3) = (at.q_WB[limb.hinge] * hinge_axis(limb.hinge)).cross(p - at.p_WB[limb.hinge]);
    return J;
  }
};

/// Where the camera of a frame is, in the world.
Vector3d eye_at(const Keypoints& keypoints, int t) {
  const Eigen::Matrix4d& E = camera_at(keypoints.extrinsics, t);
  return -E.topLeftCorner<3, 3>().transpose() * E.topRightCorner<3, 1>();
}

/// How far a capsule must go along a way until it has left another one.
struct Depth {
  double far = 0;   ///< m
  Vector3d point;   ///< on the capsule's axis, where it leaves last, before it goes
  Vector3d normal;  ///< from the other axis to that point when it leaves
};
/// @param out  the way, world, unit. Both axes are at least the distance between them from touching, so the
///             capsule goes on by what is missing until less than a millimetre is
Depth depth_along(const Character& character, const BodyPoses& poses, int body, int other,
                  const Vector3d& out, double reach) {
  constexpr int kSteps = 60;
  constexpr double kClose = 0.001;
  BodyPoses moved = poses;
  Depth depth;
  for (int k = 0; k < kSteps; ++k) {
    const SegmentPair near = closest_points(character, moved, body, other);
    const double distance = (near.a - near.b).norm();
    depth.point = near.a - depth.far * out;
    depth.normal = (near.a - near.b) / std::max(distance, 1e-9);
    if (reach - distance < kClose) break;
    depth.far += reach - distance;
    moved.p_WB[body] = poses.p_WB[body] + depth.far * out;
  }
  return depth;
}

/// The pairs of a situation: bodies of the limb that meet the obstacle, each with all of the obstacle's limb
/// or trunk, so that no way leads through the neck. Collars are left out: arms are always near them.
std::vector<std::array<int, 2>> pairs_of(const Character& character, const Passage& passage) {
  std::vector<std::array<int, 2>> pairs;
  for (const auto& [a, b] : character.self_pairs) {
    const int body = a == passage.obstacle ? b : a;
    if ((a != passage.obstacle && b != passage.obstacle) || kLimbOf[body] != passage.limb) continue;
    for (int other = 0; other < kBodies; ++other)
      if (kLimbOf[other] == kLimbOf[passage.obstacle] && other != kLeftCollar && other != kRightCollar)
        pairs.push_back({body, other});
  }
  return pairs;
}

/// Adds the depths of the limb in the obstacle along a way of the obstacle's frame.
void add_depths(const Situation& s, const Vector3d& way, int i, const BodyPoses& poses,
                LimbEquations& equations) {
  const Vector3d out = poses.q_WB[s.passage.obstacle] * way;
  for (const auto& [body, other] : s.pairs) {
    const double reach = reach_of(s.reference.character, body, other);
    const double kept = kLimbOf[other] == 0 ? kKeptInTrunk : kKeptInLimb * reach;
    const Depth depth = depth_along(s.reference.character, poses, body, other, out, reach - kept);
    if (depth.far <= 0.0) continue;
    // The capsule leaves when it has gone far enough along the normal.
    const Vector3d by_point = depth.normal / std::max(depth.normal.dot(out), kGrazing);
    equations.add(i, -(s.jacobian(poses, body, depth.point).transpose() * by_point), depth.far,
                  kSigmaDepthAside);
  }
}

/// Adds the shifts of hinge and tip across the line of sight.
void add_sight(const Situation& s, int i, const BodyPoses& poses, LimbEquations& equations) {
  const int t = s.stretch.first + i;
  const Vector3d eye = eye_at(*s.reference.keypoints, t);
  for (int body : {s.limb.hinge, s.limb.tip}) {
    const Vector3d& was = s.reference.poses[t].p_WB[body];
    const Vector3d ray = (was - eye).normalized();
    const Matrix3d across = Matrix3d::Identity() - ray * ray.transpose();
    const Vector3d shift = across * (poses.p_WB[body] - was);
    const LimbJacobian J = across * s.jacobian(poses, body, poses.p_WB[body]);
    for (int axis = 0; axis < 3; ++axis) equations.add(i, J.row(axis).transpose(), shift[axis], kSigmaSeen);
  }
}

SmoothCorrection<kLimbUnknowns> go(const Situation& s, const Vector3d& way) {
  const auto residuals = [&](const List<LimbTurns>& c, LimbEquations& equations) {
    for (int i = 0; i < c.count(); ++i) {
      const BodyPoses poses = s.poses(i, c[i]);
      add_depths(s, way, i, poses, equations);
      if (s.reference.keypoints) add_sight(s, i, poses, equations);
    }
  };
  return smooth_correction<kLimbUnknowns>(s.stretch, s.reference.size(), s.reference.fps, kLimbSigmas,
                                          residuals);
}

/// Squared distances of the limb's keypoints from their detections, over σ², weighted with the confidences.
double distance_from_detections(const Situation& s, int i, const BodyPoses& poses) {
  const Keypoints& keypoints = *s.reference.keypoints;
  const int t = s.stretch.first + i;
  const Eigen::Matrix4d& E = camera_at(keypoints.extrinsics, t);
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e30), high = -low;
  for (const Vector3d& seen : keypoints.uvc[t])
    if (seen.allFinite() && seen.z() > 0.0)
      low = low.cwiseMin(seen.head<2>()), high = high.cwiseMax(seen.head<2>());
  const double box = (high - low).maxCoeff();
  if (!(box > 0.0)) return 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < keypoints.names.size(); ++k) {
    const auto place = place_of_keypoint(keypoints.names[k]);
    const Vector3d& seen = keypoints.uvc[t][k];
    if (!place || kLimbOf[place->body] != s.limb.number || !seen.allFinite() || seen.z() <= 0.0) continue;
    const Vector3d p =
        poses.p_WB[place->body] + poses.q_WB[place->body] * place_on(s.reference.character, *place);
    const Vector3d pixel = keypoints.intrinsics * (E * p.homogeneous()).head<3>();
    if (pixel.z() <= 0.0) continue;
    const double off = std::min((pixel.hnormalized() - seen.head<2>()).norm() / box, kFarDetection);
    sum += seen.z() * off * off / (kSigmaDetection * kSigmaDetection);
  }
  return sum;
}

/// The ways around: across the passage, and back.
std::vector<Vector3d> ways_around(const Passage& p) {
  std::vector<Vector3d> ways;
  for (const Vector3d& side : {p.before, p.after})
    if (!side.isZero()) ways.push_back(side);
  if (ways.size() < 2) return ways;
  const Vector3d through = (p.after - p.before).normalized();
  const Vector3d first = through.unitOrthogonal(), second = through.cross(first);
  if (p.after.dot(p.before) > 0.0) return {(p.after + p.before).normalized()};
  ways.clear();
  for (int k = 0; k < kWaysAcross; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kWaysAcross;
    ways.emplace_back(cos(angle) * first + sin(angle) * second);
  }
  return ways;
}

/// Whether the limb still passes through the obstacle.
bool still_passes(const Situation& s, const List<LimbTurns>& c) {
  std::vector<Vector3d> before;
  for (int i = 0; i < c.count(); ++i) {
    const BodyPoses poses = s.poses(i, c[i]);
    std::vector<Vector3d> now;
    for (const auto& [body, other] : s.pairs) now.push_back(apart_of(s.reference, poses, body, other));
    for (std::size_t k = 0; i > 0 && k < now.size(); ++k)
      if (flips(before[k], now[k], reach_of(s.reference.character, s.pairs[k][0], s.pairs[k][1])))
        return true;
    before = std::move(now);
  }
  return false;
}

struct Way {
  double cost = 0;
  List<LimbTurns> c;
  TurnedLimb limb;
  FrameSpan stretch;
};

/// The cheapest way of a passage; none if all of them lead through the body.
std::optional<Way> cheapest_way(const Reference& reference, const Passage& passage) {
  const int around = static_cast<int>(std::ceil(kBeforeAndAfter * reference.fps));
  const Situation s{
      reference,
      passage,
      limb_of(passage.limb),
      {std::max(passage.first - around, 0), std::min(passage.last + around + 1, reference.size())},
      pairs_of(reference.character, passage)};
  std::optional<Way> best;
  for (const Vector3d& way : ways_around(passage)) {
    SmoothCorrection<kLimbUnknowns> found = go(s, way);
    if (still_passes(s, found.c)) continue;
    if (reference.keypoints)
      for (int i = 0; i < found.c.count(); ++i)
        found.cost += distance_from_detections(s, i, s.poses(i, found.c[i])) -
                      distance_from_detections(s, i, reference.poses[s.stretch.first + i]);
    if (!best || found.cost < best->cost) best = Way{found.cost, std::move(found.c), s.limb, s.stretch};
  }
  return best;
}

/// Whether a leg stands in a passage.
bool stands(const Reference& reference, const Passage& passage) {
  if (passage.limb >= 3) return false;
  const PerFrame<bool> standing = standing_frames(
      reference.poses, passage.limb == 1 ? kLeftAnkle : kRightAnkle, reference.fps, reference.scene);
  return std::any_of(standing.begin() + passage.first, standing.begin() + passage.last + 1,
                     [](bool s) { return s; });
}

/// Applies a way. @return largest distance that a joint moved, m
double apply(const Way& way, const Passage& passage, Reference& reference) {
  const Reference before = reference;
  const Situation s{before, passage, way.limb, way.stretch, {}};
  double moved = 0.0;
  for (int i = 0; i < way.c.count(); ++i) {
    const int t = way.stretch.first + i;
    reference.frames[t].q = s.turned(i, way.c[i]);
    reference.poses[t] = s.poses(i, way.c[i]);
    for (int body = 0; body < kBodies; ++body)
      moved = std::max(moved, (reference.poses[t].p_WB[body] - before.poses[t].p_WB[body]).norm());
  }
  return moved;
}

bool same_place(const Passage& a, const Passage& b) {
  const bool both = a.limb == b.limb && kLimbOf[a.obstacle] == kLimbOf[b.obstacle];
  const bool mirrored = a.limb == kLimbOf[b.obstacle] && b.limb == kLimbOf[a.obstacle];
  return (both || mirrored) && a.first <= b.last && b.first <= a.last;
}

}  // namespace

PassageReport lead_limbs_around(Reference& reference) {
  PassageReport report;
  List<Passage> given_up;
  const auto others = [&] {
    List<Passage> found = all_passages(reference);
    std::erase_if(found, [&](const Passage& p) {
      return std::any_of(given_up.begin(), given_up.end(),
                         [&](const Passage& g) { return same_place(p, g); });
    });
    return found;
  };
  List<Passage> found = others();
  const int most = std::max(kMostPassages, reference.size() / kFramesPerPassage);
  for (int k = 0; k < most && !found.empty(); ++k, found = others()) {
    if (report.passages++ == 0) {
      report.first_frame = found[0].first;
      report.limb_body = found[0].body;
      report.obstacle = found[0].obstacle;
    }
    // The same passage seen from its other limb, or by other bodies of the same limb.
    std::optional<Way> best;
    Passage chosen = found[0];
    for (const Passage& p : found) {
      if (!same_place(p, found[0]) || stands(reference, p)) continue;
      std::optional<Way> way = cheapest_way(reference, p);
      if (way && (!best || way->cost < best->cost)) best = std::move(way), chosen = p;
    }
    if (best) {
      report.moved = std::max(report.moved, apply(*best, chosen, reference));
    } else {
      ++report.remaining;
      given_up.push_back(found[0]);
    }
  }
  while (!found.empty()) {
    ++report.passages;
    ++report.remaining;
    std::erase_if(found, [left = found[0]](const Passage& p) { return same_place(p, left); });
  }
  return report;
}

}  // namespace mimicx::motion
