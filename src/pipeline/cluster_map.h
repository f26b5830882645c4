/// A map of motions for the report: the training motions of the options, their clusters and the clips of a
/// run, by the first two principal components of the training motions' features.
///
/// A point is a motion, and similar motions are near each other. Distances are those of clustering
/// (pipeline::options::scaled_features), projected onto the two directions in which the training motions
/// differ most (I. T. Jolliffe, "Principal Component Analysis", 2002, ch. 1).
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/options/clusters.h"
#include "run/run_config.h"

namespace mimicx::pipeline {

/// A direction of the map.
struct MapAxis {
  Eigen::VectorXd
      direction;       ///< unit, [kFeatures] of scaled features; the larger part of its entries is positive
  double share = 0.0;  ///< of the motions' variance
  std::string words;   ///< what increases along the axis: "more speed across the floor"
};

struct MapPoint {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< features' units, from the mean of the training motions
  int cluster = 0;
  std::string name;  ///< of a training motion
  int row = -1;      ///< of the report, of a clip of the run
};

struct ClusterMap {
  options::MotionFeatures middle{};  ///< scaled features of the mean training motion
  std::array<MapAxis, 2> axes;
  std::vector<std::string> clusters;  ///< in words, by number
  std::vector<MapPoint> trained;      ///< motions of the clusters
  std::vector<MapPoint> clips;        ///< of the run, in the clusters nearest to them

  Eigen::Vector2d place(const options::MotionFeatures& features) const;
};

/// Without clips. @throws std::invalid_argument for fewer than three motions whose features are known
ClusterMap map_of(const options::Clusters& clusters);

/// `axes`: {words, share}; `clusters`: {words, motions}; `trained`: [x, y, cluster, name]; `clips`: [x, y,
/// cluster, row].
std::string map_json(const ClusterMap& map);

/// The map of a run, from the clusters in its folder; empty if it has none.
std::string draw_kept_map(const record::RunFolder& folder, const record::Manifest& manifest,
                          std::vector<std::pair<std::string, std::string>>& facts);
/// The same with other clusters. @param files  clusters.json of sets of options
report::MapDrawing map_among(std::vector<std::filesystem::path> files);
/// For runs that begin from options: copies their clusters into the folder, and draws the map from there.
/// @param files  of all sets; empty: the folder's clusters are not changed
run::MotionMap run_map(std::vector<std::filesystem::path> files);

}  // namespace mimicx::pipeline
