#include "pipeline/cluster_map.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "record/json.h"

namespace mimicx::pipeline {
namespace {

/// In units of the features: all joints across the floor, and the height of the hips.
options::MotionFeatures motion_of(double across, double height) {
  options::MotionFeatures f{};
  f[options::kRootHeight] = height * options::feature_units()[options::kRootHeight];
  for (int j = 0; j < kBodies; ++j)
    f[options::kPlanarVelocity + j] = across * options::feature_units()[options::kPlanarVelocity + j];
  return f;
}

/// Motions that differ in two ways alone, 22 joints across the floor more than in the height of the hips.
options::Clusters two_clusters() {
  options::Clusters clusters;
  Random random(3);
  for (int c = 0; c < 2; ++c) {
    options::MotionCluster cluster;
    cluster.description = c == 0 ? "calm" : "fast";
    for (int i = 0; i < 20; ++i) {
      cluster.members.push_back(cluster.description + std::to_string(i));
      cluster.features.push_back(motion_of(c + 0.3 * random.uniform(), random.uniform(0.0, 1.0)));
    }
    cluster.centre = motion_of(c + 0.15, 0.5);
    clusters.clusters.push_back(cluster);
  }
  return clusters;
}

TEST(ClusterMap, FindsAndNamesTheTwoPrincipalComponents) {
  const ClusterMap map = map_of(two_clusters());
  EXPECT_EQ(map.axes[0].words, "more speed across the floor");
  EXPECT_EQ(map.axes[1].words, "more height of the hips");
  EXPECT_GT(map.axes[0].share, map.axes[1].share);
  EXPECT_NEAR(map.axes[0].share + map.axes[1].share, 1.0, 1e-9);
  EXPECT_EQ(map.clusters, (std::vector<std::string>{"calm", "fast"}));
  ASSERT_EQ(map.trained.size(), 40u);
  EXPECT_EQ(map.trained[25].name, "fast5");
  EXPECT_EQ(map.trained[25].cluster, 1);
}

/// Nothing is stretched: where all differences are seen, distances on the map are those of the features.
TEST(ClusterMap, PreservesFeatureDistances) {
  const ClusterMap map = map_of(two_clusters());
  const Eigen::Vector2d a = map.place(motion_of(0.2, 0.1)), b = map.place(motion_of(1.1, 0.9));
  EXPECT_NEAR((a - b).norm(), std::sqrt(22.0 * 0.9 * 0.9 + 0.8 * 0.8), 1e-9);
  EXPECT_GT(b.x(), a.x()) << "faster is farther to the right";
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const MapPoint& p : map.trained) mean += p.at / 40.0;
  EXPECT_LT(mean.norm(), 1e-9);
}

/// The definition of the first principal component, by trial: no other direction has more variance.
TEST(ClusterMap, FirstAxisHasTheLargestVariance) {
  const options::Clusters clusters = two_clusters();
  const ClusterMap map = map_of(clusters);
  const auto variance = [&](const Eigen::VectorXd& direction) {
    double sum = 0.0, squares = 0.0;
    for (const auto& cluster : clusters.clusters)
      for (const auto& features : cluster.features) {
        const options::MotionFeatures scaled = options::scaled_features(features);
        double along = 0.0;
        for (int k = 0; k < options::kFeatures; ++k) along += direction[k] * scaled[k];
        sum += along / 40.0;
        squares += along * along / 40.0;
      }
    return squares - sum * sum;
  };
  Random random(11);
  for (int trial = 0; trial < 100; ++trial) {
    Eigen::VectorXd direction(options::kFeatures);
    for (double& x : direction) x = random.uniform(-1.0, 1.0);
    EXPECT_LE(variance(direction.normalized()), variance(map.axes[0].direction) + 1e-9);
  }
}

TEST(ClusterMap, RejectsFewerThanThreeMotions) {
  options::Clusters clusters = two_clusters();
  for (auto& cluster : clusters.clusters) cluster.features.clear();
  EXPECT_THROW(map_of(clusters), std::invalid_argument);
}

TEST(ClusterMap, JsonHasTrainingMotionsByNameAndClipsByRow) {
  ClusterMap map = map_of(two_clusters());
  map.clips.push_back({{0.5, -0.25}, 1, "", 7});
  const auto json = record::Json::parse(map_json(map));
  EXPECT_EQ(json.at("trained").elements().size(), 40u);
  EXPECT_EQ(json.at("trained").at(25).at(3).get<std::string>(), "fast5");
  EXPECT_EQ(json.at("clips").get<std::vector<std::vector<double>>>(),
            (std::vector<std::vector<double>>{{0.5, -0.25, 1, 7}}));
  EXPECT_EQ(json.at("axes").at(0).at("words").get<std::string>(), "more speed across the floor");
}

}  // namespace
}  // namespace mimicx::pipeline
