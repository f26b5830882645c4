#include "import/retarget/skeleton_shape.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <vector>

#include "core/so3.h"
#include "core/units.h"

namespace mimicx::import {
namespace {

constexpr double kAlike = 0.1;      ///< difference of the bones of two limbs, of their length
constexpr double kLongBone = 0.24;  ///< of its limb
constexpr double kBends = 12.0;     ///< degrees: a joint that bends less only divides a bone
constexpr int kPoses = 30;          ///< that are looked at

/// The tree with the lengths of its bones in the first frame.
struct Tree {
  std::vector<std::vector<int>> children;
  std::vector<double> length;  ///< to the parent
  std::vector<double> reach;   ///< of the longest chain below
};

Tree tree_of(const SkeletonMotion& motion) {
  Tree tree;
  const std::size_t count = motion.joints.size();
  tree.children.resize(count);
  tree.length.assign(count, 0.0);
  tree.reach.assign(count, 0.0);
  for (std::size_t j = count; j-- > 0;) {
    const int parent = motion.joints[j].parent;
    if (parent < 0) continue;
    const auto p = static_cast<std::size_t>(parent);
    tree.length[j] = motion.translation.empty() ? motion.joints[j].offset.norm()
                                                : motion.translation[0][static_cast<int>(j)].norm();
    tree.children[p].push_back(static_cast<int>(j));
    tree.reach[p] = std::max(tree.reach[p], tree.reach[j] + tree.length[j]);
  }
  return tree;
}

/// From a joint down, always to the child with the longest chain.
std::vector<int> main_chain(const Tree& tree, int joint) {
  std::vector<int> chain = {joint};
  const auto reach = [&](int j) {
    return tree.reach[static_cast<std::size_t>(j)] + tree.length[static_cast<std::size_t>(j)];
  };
  while (!tree.children[static_cast<std::size_t>(chain.back())].empty()) {
    const auto& children = tree.children[static_cast<std::size_t>(chain.back())];
    chain.push_back(*std::max_element(children.begin(), children.end(),
                                      [&](int a, int b) { return reach(a) < reach(b); }));
  }
  return chain;
}

/// Two chains of equal bones.
struct Pair {
  std::vector<int> a, b;
  int parent = -1;
  double length = 0.0;  ///< of a chain, without the way to its first joint
};

/// The pairs of limbs of the tree, the longest first.
std::vector<Pair> pairs_of(const Tree& tree) {
  std::vector<Pair> pairs;
  for (std::size_t u = 0; u < tree.children.size(); ++u)
    for (std::size_t i = 0; i < tree.children[u].size(); ++i)
      for (std::size_t k = i + 1; k < tree.children[u].size(); ++k) {
        Pair pair{main_chain(tree, tree.children[u][i]), main_chain(tree, tree.children[u][k]),
                  static_cast<int>(u), 0.0};
        if (pair.a.size() != pair.b.size() || pair.a.size() < 3) continue;
        double difference = 0.0;
        for (std::size_t n = 0; n < pair.a.size(); ++n) {
          const double a = tree.length[static_cast<std::size_t>(pair.a[n])],
                       b = tree.length[static_cast<std::size_t>(pair.b[n])];
          difference += std::abs(a - b);
          if (n > 0) pair.length += a;
        }
        if (pair.length > 0.0 && difference < kAlike * pair.length) pairs.push_back(pair);
      }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& x, const Pair& y) { return x.length > y.length; });
  return pairs;
}

/// World poses of some frames.
std::vector<SkeletonPose> poses_of(const SkeletonMotion& motion) {
  std::vector<SkeletonPose> poses;
  const int step = std::max(1, motion.frames() / kPoses);
  for (int t = 0; t < motion.frames(); t += step) poses.push_back(pose_of(motion, t));
  if (poses.empty()) poses.push_back(rest_pose(motion));
  return poses;
}

/// Places in a chain of the three joints of its two long bones: hip, knee, ankle.
using LimbPlaces = std::array<std::size_t, 3>;

/// The two longest bones that follow each other, between some of the chain's joints.
std::optional<LimbPlaces> longest_bones(const std::vector<double>& at,
                                        const std::vector<std::size_t>& joints) {
  std::optional<LimbPlaces> best;
  double longest = 0.0;
  for (std::size_t n = 0; n + 2 < joints.size(); ++n) {
    const LimbPlaces limb = {joints[n], joints[n + 1], joints[n + 2]};
    const double upper = at[limb[1]] - at[limb[0]], lower = at[limb[2]] - at[limb[1]];
    if (std::min(upper, lower) < kLongBone * at.back() ||
        std::min(upper, lower) < 0.5 * std::max(upper, lower))
      continue;
    if (upper + lower > longest) longest = upper + lower, best = limb;
  }
  return best;
}

std::optional<LimbPlaces> limb_of(const Tree& tree, const std::vector<SkeletonPose>& poses,
                                  const std::vector<int>& chain) {
  std::vector<double> at = {0.0};  // way from the first joint
  std::vector<std::size_t> all = {0};
  for (std::size_t n = 1; n < chain.size(); ++n) {
    at.push_back(at.back() + tree.length[static_cast<std::size_t>(chain[n])]);
    all.push_back(n);
  }
  if (const auto limb = longest_bones(at, all)) return limb;
  std::vector<std::size_t> bending = {0};
  for (std::size_t n = 1; n + 1 < chain.size(); ++n) {
    double most = 0.0;
    for (const SkeletonPose& pose : poses) {
      const Vector3d before = pose.p[chain[n]] - pose.p[chain[n - 1]],
                     after = pose.p[chain[n + 1]] - pose.p[chain[n]];
      if (before.norm() > 0.0 && after.norm() > 0.0) most = std::max(most, angle_between(before, after));
    }
    if (most > kBends * kDegree) bending.push_back(n);
  }
  bending.push_back(chain.size() - 1);
  if (const auto limb = longest_bones(at, bending)) return limb;
  // Straight in every pose: the ends of its longest bone, and the joint next to the middle.
  std::size_t first = bending[0], last = bending[1];
  for (std::size_t n = 0; n + 1 < bending.size(); ++n)
    if (at[bending[n + 1]] - at[bending[n]] > at[last] - at[first]) first = bending[n], last = bending[n + 1];
  if (last - first < 2) return std::nullopt;
  std::size_t middle = first + 1;
  const double half = 0.5 * (at[first] + at[last]);
  for (std::size_t n = first + 1; n < last; ++n)
    if (std::abs(at[n] - half) < std::abs(at[middle] - half)) middle = n;
  return LimbPlaces{first, middle, last};
}

/// −1 for a name of the left side, 1 of the right, 0 for another.
int side_of_name(const std::string& name) {
  std::string lower;
  for (const char c : name) lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const auto& [mark, side] : {std::pair{"left", -1},
                                   {"right", 1},
                                   {"左", -1},
                                   {"右", 1},
                                   {"gauche", -1},
                                   {"droite", 1},
                                   {"links", -1},
                                   {"rechts", 1},
                                   {"izq", -1},
                                   {"der", 1}})
    if (lower.find(mark) != std::string::npos) return side;
  const auto is_mark = [&](std::size_t at) {
    const bool begins = at == 0 || !std::isalpha(static_cast<unsigned char>(name[at - 1]));
    const bool ends = at + 1 == name.size() || !std::isalpha(static_cast<unsigned char>(name[at + 1]));
    return begins && ends;
  };
  for (std::size_t at = 0; at < name.size(); ++at)
    if ((lower[at] == 'l' || lower[at] == 'r') && is_mark(at)) return lower[at] == 'l' ? -1 : 1;
  return 0;
}

int side_of_chain(const SkeletonMotion& motion, const std::vector<int>& chain) {
  int votes = 0;
  for (const int joint : chain) votes += side_of_name(motion.joints[joint].name);
  return votes;
}

/// Whether the first leg of a pair is the left one, by the names, or by where toes point and knees bend.
bool first_is_left(const SkeletonMotion& motion, const std::vector<SkeletonPose>& poses, const Pair& legs,
                   const LimbPlaces& leg, const std::vector<int>& arm, std::size_t shoulder) {
  const int votes = side_of_chain(motion, legs.b) - side_of_chain(motion, legs.a);
  if (votes != 0) return votes > 0;
  double left = 0.0;
  for (const SkeletonPose& pose : poses)
    for (const std::vector<int>& chain : {legs.a, legs.b}) {
      const auto p = [&](std::size_t n) { return pose.p[chain[std::min(n, chain.size() - 1)]]; };
      const Vector3d up = pose.p[arm[shoulder]] - p(leg[0]);
      const Vector3d toes = p(leg[2] + 1) - p(leg[2]), bend = p(leg[1]) - 0.5 * (p(leg[0]) + p(leg[2]));
      const Vector3d across = pose.p[legs.a[leg[0]]] - pose.p[legs.b[leg[0]]];
      left += across.dot(up.cross(toes + bend));
    }
  return left > 0.0;
}

void set_limb(const std::vector<int>& chain, const LimbPlaces& limb, const std::array<int, 3>& bodies,
              JointMap& map) {
  for (std::size_t n = 0; n < 3; ++n) map[bodies[n]] = chain[limb[n]];
}

/// Neck and head: the longest other chain of the joint where the arms meet.
void set_head(const SkeletonMotion& motion, const Tree& tree, const Pair& legs, const Pair& arms,
              JointMap& map) {
  const auto contains = [](const std::vector<int>& chain, int joint) {
    return std::find(chain.begin(), chain.end(), joint) != chain.end();
  };
  std::vector<int> best;
  double longest = 0.0;
  for (const int child : tree.children[static_cast<std::size_t>(arms.parent)]) {
    if (child == arms.a[0] || child == arms.b[0]) continue;
    const std::vector<int> chain = main_chain(tree, child);
    bool to_legs = contains(chain, legs.parent);
    for (int j = legs.parent; j >= 0; j = motion.joints[j].parent) to_legs = to_legs || j == child;
    const double length =
        tree.reach[static_cast<std::size_t>(child)] + tree.length[static_cast<std::size_t>(child)];
    if (!to_legs && length > longest) longest = length, best = chain;
  }
  std::erase_if(best, [&](int joint) { return motion.joints[joint].end_site; });
  if (best.empty()) return;
  map[kNeck] = best[0];
  if (best.size() > 1) map[kHead] = best[1];
}

}  // namespace

std::optional<JointMap> map_by_shape(const SkeletonMotion& motion) {
  const Tree tree = tree_of(motion);
  const std::vector<SkeletonPose> poses = poses_of(motion);
  struct Found {
    Pair pair;
    LimbPlaces limb;
  };
  std::vector<Found> limbs;  // at different joints, by the length of their two long bones
  for (const Pair& pair : pairs_of(tree)) {
    const auto limb = limb_of(tree, poses, pair.a);
    const bool inside = std::any_of(limbs.begin(), limbs.end(), [&](const Found& other) {
      for (int j = pair.parent; j >= 0; j = motion.joints[j].parent)
        if (j == other.pair.a[0] || j == other.pair.b[0]) return true;  // fingers, toes
      return other.pair.parent == pair.parent;
    });
    if (limb && !inside) limbs.push_back({pair, *limb});
    if (limbs.size() == 2) break;
  }
  if (limbs.size() < 2) return std::nullopt;
  const auto bones = [&](const Found& found) {
    double sum = 0.0;
    for (std::size_t n = found.limb[0] + 1; n <= found.limb[2]; ++n)
      sum += tree.length[static_cast<std::size_t>(found.pair.a[n])];
    return sum;
  };
  if (bones(limbs[0]) < bones(limbs[1])) std::swap(limbs[0], limbs[1]);
  auto& [legs, leg] = limbs[0];
  auto& [arms, arm] = limbs[1];
  if (!first_is_left(motion, poses, legs, leg, arms.a, arm[0])) std::swap(legs.a, legs.b);
  const Vector3d hips = poses[0].p[legs.a[leg[0]]] - poses[0].p[legs.b[leg[0]]];
  if ((poses[0].p[arms.a[arm[0]]] - poses[0].p[arms.b[arm[0]]]).dot(hips) < 0.0) std::swap(arms.a, arms.b);
  JointMap map;
  map.fill(-1);
  set_limb(legs.a, leg, {kLeftHip, kLeftKnee, kLeftAnkle}, map);
  set_limb(legs.b, leg, {kRightHip, kRightKnee, kRightAnkle}, map);
  set_limb(arms.a, arm, {kLeftShoulder, kLeftElbow, kLeftWrist}, map);
  set_limb(arms.b, arm, {kRightShoulder, kRightElbow, kRightWrist}, map);
  if (leg[2] + 1 < legs.a.size()) {
    map[kLeftFoot] = legs.a[leg[2] + 1];
    map[kRightFoot] = legs.b[leg[2] + 1];
  }
  set_head(motion, tree, legs, arms, map);
  return map;
}

}  // namespace mimicx::import
