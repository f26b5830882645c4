/// Clusters of similar motions, and their file.               docs/method.md §6
///
/// Motions are points of R⁶⁸ (pipeline/options/features.h); the clusters are the leaves of hierarchical
/// k-means (kmeans.h). One option policy is trained per cluster. Clusters are numbered from 0, the calmer
/// branch of every split first, independent of the order of the input.
///
/// The file is JSON: {"settings", "units", "tree", "clusters"}; distances and diameters are in the units of
/// the features that the file names, centres in SI units under the features' names, features of the members
/// in SI units, in the order of "units". A program with other features rejects the file. One with other units
/// reads it: what it compares itself, in SI units, it scales itself.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/containers.h"
#include "pipeline/options/features.h"

namespace mimicx::pipeline::options {

struct NamedFeatures {
  std::string name;  ///< of the motion
  MotionFeatures features;
};

struct ClusterConfig {
  double radius = 0.0;          ///< l_max: largest distance between two members of a cluster
  std::optional<int> clusters;  ///< number of clusters to make instead; `radius` then follows from it
  std::uint64_t seed = 0;
};

struct MotionCluster {
  std::string description;           ///< of its motions, in words
  std::vector<std::string> members;  ///< names, sorted
  List<MotionFeatures> features;     ///< of the members, SI units; empty from files of older programs
  MotionFeatures centre{};           ///< mean of their features, SI units
  double diameter = 0.0;             ///< largest distance between two of them
};

struct ClusterBranch {
  int parent = -1;   ///< -1: the root
  int cluster = -1;  ///< index of its cluster; -1 if it is split further
  int motions = 0;
  double diameter = 0.0;
};

struct Clusters {
  ClusterConfig settings;                  ///< with the final `radius`
  MotionFeatures units = feature_units();  ///< of radius and diameters; joined parts may have others
  std::vector<ClusterBranch> tree;  ///< depth first; [0] is the root, and every other one without a parent
  List<MotionCluster> clusters;     ///< by number
};

/// @throws std::invalid_argument without motions, for two of one name, for more clusters than distinct
///         motions, and for a radius below 0
Clusters cluster_motions(List<NamedFeatures> motions, const ClusterConfig& settings);

/// Joins several sets of clusters: numbered consecutively, described relative to all, each part with its own
/// root. `settings` then has the largest radius and the total number of clusters.
/// @throws std::invalid_argument without parts
Clusters joined(const std::vector<Clusters>& parts);

/// Index of the cluster with the nearest centre; of equally near ones the first.
int nearest_cluster(const Clusters& clusters, const MotionFeatures& features);

/// The tree with its members, indented, for people.
std::string format_cluster_tree(const Clusters& clusters);

/// The share of every kind of feature in what sets the motions apart, in a line, for people; empty if the
/// members' features are not known.
std::string format_kind_shares(const Clusters& clusters);

std::string format_clusters(const Clusters& clusters);
/// Writes a temporary file and renames it, so that a reader sees the old file or the new one.
void write_clusters(const std::filesystem::path& path, const Clusters& clusters);
/// @throws DataError for a file that holds no clusters, or clusters of other features
Clusters read_clusters(const std::filesystem::path& path);
/// Several files, joined; one file, unchanged.
Clusters read_clusters(const std::vector<std::filesystem::path>& paths);
/// The same from its text. @param path  for messages
Clusters parse_clusters(const std::string& text, const std::filesystem::path& path);

}  // namespace mimicx::pipeline::options
