// Hierarchical k-means: the bound holds, the order of the points is irrelevant, nothing is lost.
#include "pipeline/options/kmeans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "core/random.h"

namespace mimicx::pipeline::options {
namespace {

constexpr double kRounding = 1e-12;  ///< relative: two orders of the same sum

/// Blobs of normal points around random centres, with some points twice.
Points random_points(std::uint64_t seed, int count, int dimensions = 3) {
  Random random(seed, {0x626c6f62});
  Points centres(4, dimensions), points(count, dimensions);
  for (double& x : centres.reshaped()) x = 5.0 * random.normal();
  for (int i = 0; i < count; ++i)
    for (int d = 0; d < dimensions; ++d) points(i, d) = centres(i % 4, d) + random.normal();
  points.row(count - 1) = points.row(0);
  points.row(count - 2) = points.row(1);
  return points;
}

std::vector<int> shuffled(std::uint64_t seed, int count) {
  Random random(seed, {0x73687566});
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
  return order;
}

Points picked(const Points& points, const std::vector<int>& order) {
  Points out = points;
  for (std::size_t i = 0; i < order.size(); ++i) out.row(static_cast<Eigen::Index>(i)) = points.row(order[i]);
  return out;
}

/// The rows in lexicographic order, as k-means takes them.
Points sorted(const Points& points) {
  std::vector<int> order(static_cast<std::size_t>(points.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::lexicographical_compare(points.row(a).begin(), points.row(a).end(), points.row(b).begin(),
                                        points.row(b).end());
  });
  return picked(points, order);
}

double distance(const Points& points, int i, int j) { return (points.row(i) - points.row(j)).norm(); }

double brute_diameter(const Points& points, const std::vector<int>& members) {
  double largest = 0.0;
  for (int i : members)
    for (int j : members) largest = std::max(largest, distance(points, i, j));
  return largest;
}

TEST(KMeans, SeparatesTwoDistantBlobs) {
  Random random(7, {0});
  Points points(40, 2);
  for (int i = 0; i < 40; ++i) points.row(i) << random.normal() + (i % 2 ? 100.0 : 0.0), random.normal();
  const Partition p = k_means(sorted(points), 2, 1);
  for (int i = 0; i < 40; ++i) EXPECT_EQ(p.cluster[i], p.cluster[i < 20 ? 0 : 39]);
  EXPECT_NE(p.cluster[0], p.cluster[39]);
}

TEST(KMeans, FindsTheBestOfAllPartitionsOfAFewPoints) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Points points = sorted(random_points(seed, 10, 2));
    double best = std::numeric_limits<double>::infinity();
    for (unsigned mask = 1; mask < 1u << 9; ++mask) {  // the last point is on side 0
      double cost = 0.0;
      for (unsigned side : {0u, 1u}) {
        std::vector<int> members;
        for (int i = 0; i < 10; ++i)
          if (((mask >> i) & 1u) == side) members.push_back(i);
        Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(2);
        for (int i : members) mean += points.row(i) / static_cast<double>(members.size());
        for (int i : members) cost += (points.row(i) - mean).squaredNorm();
      }
      best = std::min(best, cost);
    }
    EXPECT_NEAR(k_means(points, 2, seed).cost, best, kRounding * best) << "seed " << seed;
  }
}

TEST(KMeans, EndsDespiteRoundingCycles) {
  // At 2^53 a double holds even numbers alone: the means are rounded by as much as the points are apart, and
  // the rounds of Lloyd's iteration come back to where they were.
  constexpr double kLarge = 9007199254740992.0;
  Points points(4, 1), centres(2, 1);
  points << kLarge, kLarge + 2.0, kLarge + 4.0, kLarge + 6.0;
  centres << kLarge + 4.0, kLarge + 2.0;
  const Partition p = lloyd(points, centres);
  EXPECT_EQ(std::set<int>(p.cluster.begin(), p.cluster.end()).size(), 2u) << "no cluster is empty";
}

TEST(KMeans, CentresAreMeansAndPointsGoToTheNearest) {
  const Points points = sorted(random_points(3, 50));
  const Partition p = k_means(points, 5, 0);
  Points sum = Points::Zero(5, 3);
  List<int> count(5, 0);
  for (int i = 0; i < 50; ++i) {
    const int mine = p.cluster[i];
    sum.row(mine) += points.row(i);
    ++count[mine];
    for (int c = 0; c < 5; ++c)
      EXPECT_LE((points.row(i) - p.centres.row(mine)).norm(), (points.row(i) - p.centres.row(c)).norm());
  }
  for (int c = 0; c < 5; ++c) EXPECT_LT((sum.row(c) / count[c] - p.centres.row(c)).norm(), 1e-12);
}

TEST(KMeans, RefillsEmptyCentres) {
  const Points points = sorted(random_points(5, 30));
  Points centres(4, 3);
  centres.row(0) = points.row(0);
  centres.row(1) = points.row(0);  // ties go to the first: empty
  centres.row(2).setConstant(1e6);
  centres.row(3).setConstant(-1e6);
  const Partition p = lloyd(points, centres);
  EXPECT_EQ(std::set<int>(p.cluster.begin(), p.cluster.end()), (std::set<int>{0, 1, 2, 3}));
}

TEST(KMeans, AsManyClustersAsDistinctPointsGivesEachItsOwn) {
  const Points points = sorted(random_points(6, 12));  // two of them twice
  const Partition p = k_means(points, 10, 2);
  EXPECT_EQ(std::set<int>(p.cluster.begin(), p.cluster.end()).size(), 10u);
  EXPECT_EQ(p.cost, 0.0);
  for (int i = 1; i < 12; ++i)
    EXPECT_EQ(p.cluster[i] == p.cluster[i - 1], points.row(i) == points.row(i - 1));
  EXPECT_THROW(k_means(points, 11, 2), std::invalid_argument);
  EXPECT_THROW(k_means(points, 0, 2), std::invalid_argument);
}

TEST(ClusterTree, OrderOfThePointsIsIrrelevant) {
  const Points points = random_points(10, 40);
  const ClusterTree tree = complete_tree(points, 3);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const std::vector<int> order = shuffled(seed, 40);
    const ClusterTree other = complete_tree(picked(points, order), 3);
    ASSERT_EQ(other.size(), tree.size());
    for (std::size_t n = 0; n < tree.size(); ++n) {
      EXPECT_EQ(other[n].children, tree[n].children);
      EXPECT_EQ(other[n].diameter, tree[n].diameter);
      EXPECT_TRUE(other[n].centre == tree[n].centre);
      std::vector<int> members;
      for (int i : other[n].members) members.push_back(order[static_cast<std::size_t>(i)]);
      std::sort(members.begin(), members.end());
      EXPECT_EQ(members, tree[n].members);
    }
  }
}

TEST(ClusterTree, SplitsExactlyTheNodesWiderThanTheBound) {
  const Points points = random_points(11, 80);
  const ClusterTree complete = complete_tree(points, 0);
  for (double radius : {0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 100.0})
    for (const ClusterNode& node : cut_tree(complete, radius)) {
      EXPECT_DOUBLE_EQ(node.diameter, brute_diameter(points, node.members));
      EXPECT_EQ(node.is_leaf(), node.diameter <= radius) << radius;
    }
}

TEST(ClusterTree, ChildrenPartitionTheirParentsPoints) {
  const ClusterTree tree = complete_tree(random_points(12, 50), 4);
  EXPECT_EQ(tree[0].members.size(), 50u);
  for (std::size_t n = 0; n < tree.size(); ++n) {
    if (tree[n].is_leaf()) continue;
    std::vector<int> both;
    for (int child : tree[n].children) {
      const ClusterNode& c = tree[child];
      EXPECT_EQ(c.parent, static_cast<int>(n));
      EXPECT_FALSE(c.members.empty());
      both.insert(both.end(), c.members.begin(), c.members.end());
    }
    std::sort(both.begin(), both.end());
    EXPECT_EQ(both, tree[n].members);
  }
}

auto leaves_in(const ClusterTree& tree) {
  return std::count_if(tree.begin(), tree.end(), [](const ClusterNode& node) { return node.is_leaf(); });
}

TEST(ClusterTree, GivesTheRequestedClustersAtTheWidestBound) {
  const Points points = random_points(13, 42);  // 40 distinct
  const ClusterTree complete = complete_tree(points, 5);
  for (int clusters = 1; clusters <= 40; ++clusters) {
    const double radius = radius_for_clusters(complete, clusters);
    EXPECT_EQ(leaves_in(cut_tree(complete, radius)), clusters);
  }
  EXPECT_EQ(radius_for_clusters(complete, 1), complete[0].diameter);
  EXPECT_THROW(radius_for_clusters(complete, 41), std::invalid_argument);
  EXPECT_THROW(radius_for_clusters(complete, 0), std::invalid_argument);
}

TEST(ClusterTree, EqualDiametersAreSplitTogether) {
  Points points(4, 1);
  points << 0.0, 1.0, 10.0, 11.0;  // two pairs of the same width
  const ClusterTree complete = complete_tree(points, 0);
  EXPECT_EQ(leaves_in(cut_tree(complete, radius_for_clusters(complete, 2))), 2);
  EXPECT_EQ(leaves_in(cut_tree(complete, radius_for_clusters(complete, 3))), 4);
  EXPECT_EQ(radius_for_clusters(complete, 2), 1.0);
}

TEST(ClusterTree, EqualPointsAreOneCluster) {
  const ClusterTree tree = complete_tree(Points::Constant(5, 3, 1.5), 0);
  ASSERT_EQ(tree.size(), 1u);
  EXPECT_EQ(tree[0].diameter, 0.0);
  EXPECT_EQ(radius_for_clusters(tree, 1), 0.0);
  EXPECT_THROW(complete_tree(Points(0, 3), 0), std::invalid_argument);
  EXPECT_THROW(cut_tree(tree, -1.0), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::pipeline::options
