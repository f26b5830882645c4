/// Hierarchical k-means: clusters with a bounded diameter.                     docs/method.md §6
///
/// A cluster whose diameter (the largest distance between two of its members, which the paper calls its
/// radius) exceeds the bound l_max is split recursively by k-means with k = 2, until none does. k-means is
/// Lloyd's iteration from k-means++ centres (Arthur and Vassilvitskii 2007), the best of a few starts.
///
/// The split of a node depends only on its members and the seed, not on l_max. So there is one complete tree,
/// down to single points, and l_max cuts it: a smaller l_max only splits further, and the l_max for C
/// clusters follows from the diameters.
///
/// The tree does not depend on the order of the points: they are processed in lexicographic order, and
/// random numbers are drawn for positions in that order. Equal points always share a cluster.
///
/// What it does not do: it keeps no names and knows no features (clusters.h). All pairs of members are
/// compared, so it suits thousands of points, not millions.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/containers.h"

namespace mimicx::pipeline::options {

/// Points are rows: [points][D].
using Points = Eigen::MatrixXd;

struct Partition {
  List<int> cluster;  ///< [points] nearest centre; of equally near ones the first
  Points centres;     ///< [k][D] means of the members
  double cost = 0.0;  ///< sum of squared distances to the centres
};

/// Lloyd's iteration from the given centres until nothing changes or the cost no longer falls. A centre that
/// loses its last point moves to the point farthest from its own centre, so no cluster of the result is
/// empty.
/// @param sorted  points in lexicographic order
/// @throws std::invalid_argument when there are fewer distinct points than centres
Partition lloyd(const Points& sorted, const Points& centres);

/// Best of 8 starts. @throws std::invalid_argument as `lloyd`
/// @param first  place of the first point among all points: keys the random numbers, together with how many
///               points there are (no two nodes of a tree share both)
Partition k_means(const Points& sorted, int k, std::uint64_t seed, int first = 0);

struct ClusterNode {
  int parent = -1;                      ///< -1 for the root
  std::array<int, 2> children{-1, -1};  ///< -1 for a leaf; the calmer one (smaller sum of the centre) first
  std::vector<int> members;             ///< rows of the points, ascending
  Eigen::VectorXd centre;               ///< their mean, [D]
  double diameter = 0.0;                ///< largest distance between two of them

  bool is_leaf() const { return children[0] < 0; }
};

/// Nodes in depth-first order, first child first; [0] is the root. The leaves, in this order, are the
/// clusters 0, 1, ….
using ClusterTree = List<ClusterNode>;

/// The complete tree: every leaf holds only equal points. @throws std::invalid_argument without points
ClusterTree complete_tree(const Points& points, std::uint64_t seed);

/// The top of a tree: nodes wider than `radius` keep their children, the others become leaves.
/// @throws std::invalid_argument for a negative radius
ClusterTree cut_tree(const ClusterTree& tree, double radius);

/// The largest l_max that gives at least `clusters` clusters; more only if nodes of equal diameter are split
/// together.
/// @param tree  complete
/// @throws std::invalid_argument when there are fewer distinct points, or for less than 1 cluster
double radius_for_clusters(const ClusterTree& tree, int clusters);

}  // namespace mimicx::pipeline::options
