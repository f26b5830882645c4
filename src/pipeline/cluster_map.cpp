#include "pipeline/cluster_map.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/decompositions.h"
#include "core/error.h"
#include "core/file.h"
#include "motion/clip_file.h"
#include "motion/prepare/prepare.h"
#include "record/json.h"
#include "report/base64_digits.h"

namespace mimicx::pipeline {
namespace {

using Scaled = Eigen::Matrix<double, options::kFeatures, 1>;

Scaled scaled(const options::MotionFeatures& features) {
  const options::MotionFeatures values = options::scaled_features(features);
  return Eigen::Map<const Scaled>(values.data());
}

/// What there is more or less of, in the order of kFeatureKinds.
constexpr Array<const char*, options::kFeatureKindCount> kWordsOfKinds = {
    "height of the hips", "turning", "speed across the floor", "speed up and down", "acceleration"};
constexpr double kWorthSaying = 0.1;  ///< smaller parts of a direction's squared length get no words

/// "more speed across the floor, less height of the hips", the largest part first.
std::string words_of(const Eigen::VectorXd& direction) {
  std::vector<std::pair<double, std::string>> parts;
  for (int k = 0; k < options::kFeatureKindCount; ++k) {
    const auto part = direction.segment(options::kFeatureKinds[k].first, options::kFeatureKinds[k].entries);
    if (part.squaredNorm() >= kWorthSaying)
      parts.emplace_back(part.squaredNorm(),
                         std::string(part.sum() > 0.0 ? "more " : "less ") + kWordsOfKinds[k]);
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text;
  for (const auto& [share, words] : parts) text += (text.empty() ? "" : ", ") + words;
  return text;
}

constexpr double kMapSteps = 1e4;  ///< per unit of the map's numbers: more precise than visible

/// Puts a motion of the run on the map, by its prepared reference, which also decides the nearest cluster. A
/// missing or too short one is left out.
void add_clip(const record::RunFolder& folder, const record::SequenceEntry& entry, int row,
              const options::Clusters& clusters, ClusterMap& map) {
  const std::filesystem::path file = folder.reference(entry.name);
  if (entry.output.empty() || !std::filesystem::exists(file)) return;
  try {
    const motion::PreparationConfig as_it_is{
        .separate = false, .level_feet = false, .ground = false, .plant = false, .bridge_flagged = false};
    const options::MotionFeatures features =
        options::motion_features(motion::prepare_reference(motion::read_clip(file), as_it_is, nullptr));
    map.clips.push_back({map.place(features), options::nearest_cluster(clusters, features), "", row});
  } catch (const DataError&) {
    return;
  }
}

std::string draw_map(const record::RunFolder& folder, const record::Manifest& manifest,
                     const std::vector<std::filesystem::path>& files,
                     std::vector<std::pair<std::string, std::string>>& facts) {
  try {
    const options::Clusters clusters = options::read_clusters(files);
    ClusterMap map = map_of(clusters);
    for (std::size_t row = 0; row < manifest.sequences.size(); ++row)
      add_clip(folder, manifest.sequences[row], static_cast<int>(row), clusters, map);
    return map_json(map);
  } catch (const std::invalid_argument&) {
    facts.emplace_back("no map of the motions", "the options' clusters.json does not have their features");
  } catch (const DataError&) {
    facts.emplace_back("no map of the motions", "the options' clusters.json cannot be read");
  }
  return "";
}

/// Copies the clusters into the folder, so that the report does not depend on the options' files.
void keep_clusters(const std::vector<std::filesystem::path>& files, const record::RunFolder& folder,
                   std::ostream& messages) {
  if (files.empty() || std::filesystem::exists(folder.clusters())) return;
  if (files.size() == 1) {
    write_file_atomically(folder.clusters(), read_file(files.front()));
    return;
  }
  try {
    options::write_clusters(folder.clusters(), options::read_clusters(files));
  } catch (const DataError& error) {
    messages << error.what() << ": the report has no map of the motions\n";
  }
}

}  // namespace

Eigen::Vector2d ClusterMap::place(const options::MotionFeatures& features) const {
  const Scaled from_middle = scaled(features) - Eigen::Map<const Scaled>(middle.data());
  return {axes[0].direction.dot(from_middle), axes[1].direction.dot(from_middle)};
}

ClusterMap map_of(const options::Clusters& clusters) {
  std::vector<Scaled> points;
  for (const options::MotionCluster& cluster : clusters.clusters)
    for (const options::MotionFeatures& features : cluster.features) points.push_back(scaled(features));
  if (points.size() < 3)
    throw std::invalid_argument("map_of: features of fewer than three motions are known");
  ClusterMap map;
  Scaled mean = Scaled::Zero();
  for (const Scaled& p : points) mean += p / static_cast<double>(points.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(options::kFeatures, options::kFeatures);
  for (const Scaled& p : points) covariance += (p - mean) * (p - mean).transpose();
  std::copy(mean.begin(), mean.end(), map.middle.begin());
  const SymmetricEigen spread = symmetric_eigen(covariance);
  for (int k = 0; k < 2; ++k) {
    Eigen::VectorXd direction = spread.vectors.col(options::kFeatures - 1 - k);
    if (direction.sum() < 0.0) direction *= -1.0;  // the sign of a principal direction is arbitrary
    const double all = covariance.trace(), own = spread.values[options::kFeatures - 1 - k];
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
    json["axes"].push_back({{"words", axis.words}, {"share", report::rounded(axis.share, kMapSteps)}});
  const auto add = [&json](const char* list, const MapPoint& point, const record::Json& who) {
    record::Json one = record::Json::array();
    for (const double x : point.at) one.push_back(report::rounded(x, kMapSteps));
    one.push_back(point.cluster);
    one.push_back(who);
    json[list].push_back(one);
  };
  for (const MapPoint& point : map.trained) add("trained", point, point.name);
  for (const MapPoint& point : map.clips) add("clips", point, point.row);
  return json.dump();
}

std::string draw_kept_map(const record::RunFolder& folder, const record::Manifest& manifest,
                          std::vector<std::pair<std::string, std::string>>& facts) {
  return std::filesystem::exists(folder.clusters()) ? draw_map(folder, manifest, {folder.clusters()}, facts)
                                                    : "";
}

report::MapDrawing map_among(std::vector<std::filesystem::path> files) {
  return [files = std::move(files)](const auto& folder, const auto& manifest, auto& facts) {
    return draw_map(folder, manifest, files, facts);
  };
}

run::MotionMap run_map(std::vector<std::filesystem::path> files) {
  return {
      .keep = [files = std::move(files)](const record::RunFolder& folder,
                                         std::ostream& messages) { keep_clusters(files, folder, messages); },
      .draw = draw_kept_map};
}

}  // namespace mimicx::pipeline
