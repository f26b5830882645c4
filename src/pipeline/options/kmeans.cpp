#include "pipeline/options/kmeans.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "core/random.h"

namespace mimicx::pipeline::options {
namespace {

using Index = Eigen::Index;

constexpr std::uint64_t kPurpose = 0x6b6d65616e73;  ///< of the random streams: "kmeans"
constexpr int kStarts = 8;

/// < 0, 0, > 0: lexicographic order of two rows.
int compare(const Points& points, int a, int b) {
  for (Index d = 0; d < points.cols(); ++d)
    if (points(a, d) != points(b, d)) return points(a, d) < points(b, d) ? -1 : 1;
  return 0;
}

/// Rows in lexicographic order; equal rows in theirs.
List<int> canonical_order(const Points& points) {
  List<int> order(points.rows());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return compare(points, a, b) < 0; });
  return order;
}

Points rows(const Points& points, const std::vector<int>& which) {
  Points out(static_cast<Index>(which.size()), points.cols());
  for (std::size_t i = 0; i < which.size(); ++i) out.row(static_cast<Index>(i)) = points.row(which[i]);
  return out;
}

/// @param sorted  in canonical order
int distinct_rows(const Points& sorted) {
  int distinct = sorted.rows() > 0 ? 1 : 0;
  for (int i = 1; i < sorted.rows(); ++i) distinct += compare(sorted, i - 1, i) != 0;
  return distinct;
}

void require_clusters(const Points& sorted, Index k) {
  if (k < 1 || distinct_rows(sorted) < k)
    throw std::invalid_argument("k-means: expected 1 to " + std::to_string(distinct_rows(sorted)) +
                                " clusters (there are no more distinct points), found " + std::to_string(k));
}

double squared_distance(const Points& points, Index i, const Points& centres, Index c) {
  return (points.row(i) - centres.row(c)).squaredNorm();
}

/// Fills `cluster` with the nearest centres. @return whether anything changed
bool assign(const Points& points, Partition& p) {
  bool changed = false;
  p.cost = 0.0;
  for (Index i = 0; i < points.rows(); ++i) {
    Index nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (Index c = 0; c < p.centres.rows(); ++c) {
      const double d = squared_distance(points, i, p.centres, c);
      if (d < least) nearest = c, least = d;
    }
    int& cluster = p.cluster[i];
    changed = changed || cluster != nearest;
    cluster = static_cast<int>(nearest);
    p.cost += least;
  }
  return changed;
}

/// The point that is farthest from the centres of `taken`.
Index farthest_point(const Points& points, const Points& centres, const List<bool>& taken) {
  Index farthest = 0;
  double most = -1.0;
  for (Index i = 0; i < points.rows(); ++i) {
    double near = std::numeric_limits<double>::infinity();
    for (Index c = 0; c < centres.rows(); ++c)
      if (taken[c]) near = std::min(near, squared_distance(points, i, centres, c));
    if (near > most) farthest = i, most = near;
  }
  return farthest;
}

/// Moves every centre to the mean of its points, then those without points to where they get some.
void move_centres(const Points& points, Partition& p) {
  Points sum = Points::Zero(p.centres.rows(), p.centres.cols());
  List<int> count(p.centres.rows(), 0);
  for (Index i = 0; i < points.rows(); ++i) {
    const int c = p.cluster[i];
    sum.row(c) += points.row(i);
    ++count[c];
  }
  List<bool> taken(count.size());
  for (int c = 0; c < count.count(); ++c) {
    taken[c] = count[c] > 0;
    if (taken[c]) p.centres.row(c) = sum.row(c) / count[c];
  }
  for (int c = 0; c < count.count(); ++c) {
    if (taken[c]) continue;
    p.centres.row(c) = points.row(farthest_point(points, p.centres, taken));
    taken[c] = true;
  }
}

/// k-means++: the first centre is any point, each further one a point drawn with a probability proportional
/// to its squared distance from the nearest centre so far. Arthur and Vassilvitskii 2007, §2.2.
Points draw_centres(const Points& sorted, Index k, Random& random) {
  const auto n = static_cast<std::uint32_t>(sorted.rows());
  Points centres(k, sorted.cols());
  centres.row(0) = sorted.row(static_cast<Index>(random.below(n)));
  std::vector<double> weight(n, std::numeric_limits<double>::infinity());
  for (Index c = 1; c < k; ++c) {
    double total = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      weight[i] = std::min(weight[i], squared_distance(sorted, static_cast<Index>(i), centres, c - 1));
      total += weight[i];
    }
    double left = random.uniform() * total;
    Index drawn = -1;  // the last point with any weight, should rounding leave something over
    for (std::size_t i = 0; i < n && left >= 0.0; ++i) {
      if (weight[i] <= 0.0) continue;
      drawn = static_cast<Index>(i);
      left -= weight[i];
    }
    centres.row(c) = sorted.row(drawn);
  }
  return centres;
}

double diameter_of(const Points& points) {
  double largest = 0.0;
  for (Index i = 0; i < points.rows(); ++i)
    for (Index j = 0; j < i; ++j) largest = std::max(largest, squared_distance(points, i, points, j));
  return std::sqrt(largest);
}

/// Adds the node of these members (places in `sorted`, ascending) and everything below it. @return its index
int grow(const Points& sorted, std::uint64_t seed, std::vector<int> members, int parent, ClusterTree& tree) {
  const Points mine = rows(sorted, members);
  const auto index = static_cast<int>(tree.size());
  ClusterNode node;
  node.parent = parent;
  node.centre = mine.colwise().mean().transpose();
  node.diameter = diameter_of(mine);
  node.members = members;
  tree.push_back(node);
  if (compare(mine, 0, static_cast<int>(mine.rows()) - 1) == 0) return index;  // all points are equal

  const Partition halves = k_means(mine, 2, seed, members.front());
  const int calm = halves.centres.row(0).sum() <= halves.centres.row(1).sum() ? 0 : 1;
  std::array<std::vector<int>, 2> parts;
  for (std::size_t i = 0; i < members.size(); ++i)
    parts[halves.cluster[i] == calm ? 0 : 1].push_back(members[i]);
  for (std::size_t side = 0; side < 2; ++side) {
    const int child = grow(sorted, seed, std::move(parts[side]), index, tree);
    tree[index].children[side] = child;
  }
  return index;
}

int copy_top(const ClusterTree& tree, int from, double radius, int parent, ClusterTree& top) {
  const auto index = static_cast<int>(top.size());
  ClusterNode node = tree[from];
  const auto children = node.children;
  node.parent = parent;
  node.children = {-1, -1};
  const bool split = !tree[from].is_leaf() && node.diameter > radius;
  top.push_back(std::move(node));
  for (std::size_t side = 0; split && side < 2; ++side) {
    const int child = copy_top(tree, children[side], radius, index, top);
    top[index].children[side] = child;
  }
  return index;
}

}  // namespace

/// Why it ends: no step raises the cost. The nearest centre costs a point least, the mean costs a cluster
/// least, and the centre of an empty cluster costs nothing wherever it is. A cost that falls belongs to a
/// partition that has not been there before, and there are finitely many. Rounded means could go round for
/// ever, so the first round that does not lower the cost is the last.
/// A partition that no longer changes has no empty cluster: the centre of one would have been moved onto a
/// point that is nearer to it than to all others.
Partition lloyd(const Points& sorted, const Points& centres) {
  require_clusters(sorted, centres.rows());
  Partition p{List<int>(sorted.rows(), -1), centres, 0.0};
  double cost = std::numeric_limits<double>::infinity();
  while (assign(sorted, p) && p.cost < cost) {
    cost = p.cost;
    move_centres(sorted, p);
  }
  return p;
}

Partition k_means(const Points& sorted, int k, std::uint64_t seed, int first) {
  require_clusters(sorted, k);
  Partition best;
  for (int start = 0; start < kStarts; ++start) {
    Random random(seed, {kPurpose, static_cast<std::uint64_t>(first),
                         static_cast<std::uint64_t>(sorted.rows()), static_cast<std::uint64_t>(start)});
    Partition p = lloyd(sorted, draw_centres(sorted, k, random));
    if (start == 0 || p.cost < best.cost) best = std::move(p);
  }
  return best;
}

ClusterTree complete_tree(const Points& points, std::uint64_t seed) {
  if (points.rows() == 0) throw std::invalid_argument("complete_tree: no points");
  const List<int> order = canonical_order(points);
  std::vector<int> all(order.size());
  std::iota(all.begin(), all.end(), 0);
  ClusterTree tree;
  grow(rows(points, order), seed, std::move(all), -1, tree);
  for (ClusterNode& node : tree) {
    for (int& member : node.members) member = order[member];
    std::sort(node.members.begin(), node.members.end());
  }
  return tree;
}

ClusterTree cut_tree(const ClusterTree& tree, double radius) {
  if (!(radius >= 0.0)) throw std::invalid_argument("cut_tree: the radius must not be negative");
  ClusterTree top;
  copy_top(tree, 0, radius, -1, top);
  return top;
}

double radius_for_clusters(const ClusterTree& tree, int clusters) {
  // Every split adds one leaf. A node is never wider than its parent, so the nodes wider than a radius are
  // the top of the tree, and counting them counts the splits.
  std::vector<double> diameters;
  for (const ClusterNode& node : tree)
    if (!node.is_leaf()) diameters.push_back(node.diameter);
  std::sort(diameters.begin(), diameters.end(), std::greater<>());
  const auto possible = static_cast<int>(diameters.size()) + 1;
  if (clusters < 1 || clusters > possible)
    throw std::invalid_argument("expected 1 to " + std::to_string(possible) +
                                " clusters (there are no more distinct motions), found " +
                                std::to_string(clusters));
  if (clusters == possible) return 0.0;
  // The widest node that stays whole. Nodes as wide as the last one that is split are split with it.
  auto whole = diameters.begin() + (clusters - 1);
  const double split = clusters > 1 ? *(whole - 1) : std::numeric_limits<double>::infinity();
  whole = std::find_if(whole, diameters.end(), [&](double d) { return d < split; });
  return whole == diameters.end() ? 0.0 : *whole;
}

}  // namespace mimicx::pipeline::options
