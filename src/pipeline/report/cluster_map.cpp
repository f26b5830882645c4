#include "pipeline/report/cluster_map.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <stdexcept>

#include "pipeline/record/json.h"
#include "pipeline/report/digits.h"

namespace mimicx::pipeline::report {
namespace {

using Scaled = Eigen::Matrix<double, motion::kFeatures, 1>;

Scaled scaled(const motion::MotionFeatures& features) {
  const motion::MotionFeatures values = motion::scaled_features(features);
  return Eigen::Map<const Scaled>(values.data());
}

/// Features that say the same of all joints, in words: what there is more or less of.
struct FeatureKind {
  int first, count;
  const char* words;
};
constexpr FeatureKind kKinds[] = {{motion::kRootHeight, 1, "height of the hips"},
                                  {motion::kRootTurning, 1, "turning"},
                                  {motion::kPlanarVelocity, kBodies, "speed across the floor"},
                                  {motion::kVerticalVelocity, kBodies, "speed up and down"},
                                  {motion::kAcceleration, kBodies, "acceleration"}};
constexpr double kWorthSaying = 0.1;  ///< of a direction's squared length

/// "more speed across the floor, less height of the hips": the largest part first.
std::string words_of(const Eigen::VectorXd& direction) {
  std::vector<std::pair<double, std::string>> parts;
  for (const FeatureKind& kind : kKinds) {
    const auto part = direction.segment(kind.first, kind.count);
    if (part.squaredNorm() >= kWorthSaying)
      parts.emplace_back(part.squaredNorm(),
                         (part.sum() > 0.0 ? "more " : "less ") + std::string(kind.words));
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text;
  for (const auto& [share, words] : parts) text += (text.empty() ? "" : ", ") + words;
  return text;
}

constexpr double kMapSteps = 1e4;  ///< more than a map shows

}  // namespace

Eigen::Vector2d ClusterMap::place(const motion::MotionFeatures& features) const {
  const Scaled from_middle = scaled(features) - Eigen::Map<const Scaled>(middle.data());
  return {axes[0].direction.dot(from_middle), axes[1].direction.dot(from_middle)};
}

ClusterMap map_of(const options::Clusters& clusters) {
  std::vector<Scaled> points;
  for (const options::MotionCluster& cluster : clusters.clusters)
    for (const motion::MotionFeatures& features : cluster.features) points.push_back(scaled(features));
  if (points.size() < 3)
    throw std::invalid_argument("map_of: features of fewer than three motions are known");
  ClusterMap map;
  Scaled mean = Scaled::Zero();
  for (const Scaled& p : points) mean += p / static_cast<double>(points.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(motion::kFeatures, motion::kFeatures);
  for (const Scaled& p : points) covariance += (p - mean) * (p - mean).transpose();
  std::copy(mean.begin(), mean.end(), map.middle.begin());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  for (int k = 0; k < 2; ++k) {
    Eigen::VectorXd direction = solver.eigenvectors().col(motion::kFeatures - 1 - k);
    if (direction.sum() < 0.0) direction *= -1.0;  // a direction has no sign of its own
    const double all = covariance.trace(), own = solver.eigenvalues()[motion::kFeatures - 1 - k];
    map.axes[static_cast<std::size_t>(k)] = {direction, all > 0.0 ? own / all : 0.0, words_of(direction)};
  }
  for (int c = 0; c < clusters.clusters.count(); ++c) {
    const options::MotionCluster& cluster = clusters.clusters[c];
    map.clusters.push_back(cluster.description);
    for (int i = 0; i < cluster.features.count(); ++i)
      map.trained.push_back(
          {map.place(cluster.features[i]), c, cluster.members[static_cast<std::size_t>(i)], -1});
  }
  return map;
}

std::string map_json(const ClusterMap& map) {
  record::Json json = {{"axes", record::Json::array()},
                       {"clusters", map.clusters},
                       {"trained", record::Json::array()},
                       {"clips", record::Json::array()}};
  for (const MapAxis& axis : map.axes)
    json["axes"].push_back({{"words", axis.words}, {"share", rounded(axis.share, kMapSteps)}});
  const auto add = [&json](const char* list, const MapPoint& point, const record::Json& who) {
    record::Json one = record::Json::array();
    for (const double x : point.at) one.push_back(rounded(x, kMapSteps));
    one.push_back(point.cluster);
    one.push_back(who);
    json[list].push_back(one);
  };
  for (const MapPoint& point : map.trained) add("trained", point, point.name);
  for (const MapPoint& point : map.clips) add("clips", point, point.row);
  return json.dump();
}

}  // namespace mimicx::pipeline::report
