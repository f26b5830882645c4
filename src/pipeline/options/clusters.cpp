#include "pipeline/options/clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/number_text.h"
#include "pipeline/options/cluster_words.h"
#include "pipeline/options/kmeans.h"
#include "record/json.h"
#include "record/run_folder.h"

namespace mimicx::pipeline::options {
namespace {

/// By features and name, so that the order of the input decides nothing.
/// @throws std::invalid_argument for what cannot be clustered
void make_canonical(std::vector<NamedFeatures>& motions) {
  if (motions.empty()) throw std::invalid_argument("cluster_motions: there are no motions");
  std::sort(motions.begin(), motions.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (i > 0 && motions[i].name == motions[i - 1].name)
      throw std::invalid_argument("cluster_motions: two motions are named " + motions[i].name);
    const auto& f = motions[i].features;
    if (!std::all_of(f.begin(), f.end(), [](double x) { return std::isfinite(x); }))
      throw std::invalid_argument("cluster_motions: " + motions[i].name +
                                  " has features that are not finite");
  }
}

/// Rows: scaled features.
Points points_of(const std::vector<NamedFeatures>& motions) {
  Points points(static_cast<Eigen::Index>(motions.size()), kFeatures);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const MotionFeatures scaled = scaled_features(motions[i].features);
    points.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::Matrix<double, 1, kFeatures>>(scaled.data());
  }
  return points;
}

MotionCluster cluster_of(const ClusterNode& leaf, const List<NamedFeatures>& motions) {
  MotionCluster cluster;
  for (int member : leaf.members) {
    cluster.members.push_back(motions[member].name);
    cluster.features.push_back(motions[member].features);
  }
  for (std::size_t k = 0; k < kFeatures; ++k)
    cluster.centre[k] = feature_units()[k] * leaf.centre[static_cast<Eigen::Index>(k)];
  cluster.diameter = leaf.diameter;
  return cluster;
}

/// Each among the others.
void describe(List<MotionCluster>& clusters) {
  List<MotionFeatures> centres;
  for (const MotionCluster& cluster : clusters) centres.push_back(cluster.centre);
  for (int c = 0; c < centres.count(); ++c) clusters[c].description = describe_cluster(centres, c);
}

record::Json named(const MotionFeatures& values) {
  record::Json json = record::Json::object();
  for (std::size_t k = 0; k < kFeatures; ++k) json[feature_names()[k]] = values[k];
  return json;
}

MotionFeatures unnamed(const record::Json& json) {
  MotionFeatures values;
  for (std::size_t k = 0; k < kFeatures; ++k) values[k] = json.at(feature_names()[k]);
  return values;
}

ClusterBranch branch_of(const record::Json& json) {
  ClusterBranch branch;
  branch.parent = json.at("parent");
  if (!json.at("cluster").is_null()) branch.cluster = json.at("cluster");
  branch.motions = json.at("motions");
  branch.diameter = json.at("diameter");
  return branch;
}

MotionCluster cluster_of(const record::Json& json) {
  MotionCluster cluster;
  cluster.description = json.at("description").get<std::string>();
  cluster.members = json.at("members").get<std::vector<std::string>>();
  if (json.contains("features"))
    for (const record::Json& features : json.at("features").elements())
      cluster.features.push_back(features.get<MotionFeatures>());
  if (!cluster.features.empty() && cluster.features.size() != cluster.members.size())
    throw record::JsonError("features of " + std::to_string(cluster.features.size()) + " of " +
                            std::to_string(cluster.members.size()) + " members");
  cluster.centre = unnamed(json.at("centre"));
  cluster.diameter = json.at("diameter");
  return cluster;
}

}  // namespace

Clusters cluster_motions(List<NamedFeatures> motions, const ClusterConfig& settings) {
  make_canonical(motions);
  Clusters out;
  out.settings = settings;
  const ClusterTree complete = complete_tree(points_of(motions), settings.seed);
  if (settings.clusters) out.settings.radius = radius_for_clusters(complete, *settings.clusters);
  for (const ClusterNode& node : cut_tree(complete, out.settings.radius)) {
    ClusterBranch branch{node.parent, -1, static_cast<int>(node.members.size()), node.diameter};
    if (node.is_leaf()) {
      branch.cluster = static_cast<int>(out.clusters.size());
      out.clusters.push_back(cluster_of(node, motions));
    }
    out.tree.push_back(branch);
  }
  describe(out.clusters);
  return out;
}

Clusters joined(const std::vector<Clusters>& parts) {
  if (parts.empty()) throw std::invalid_argument("joined: there are no clusters");
  if (parts.size() == 1) return parts.front();
  Clusters all;
  all.settings = parts.front().settings;
  for (const Clusters& part : parts) {
    const int branches = static_cast<int>(all.tree.size()), clusters = all.clusters.count();
    for (ClusterBranch branch : part.tree) {
      if (branch.parent >= 0) branch.parent += branches;
      if (branch.cluster >= 0) branch.cluster += clusters;
      all.tree.push_back(branch);
    }
    all.clusters.insert(all.clusters.end(), part.clusters.begin(), part.clusters.end());
    all.settings.radius = std::max(all.settings.radius, part.settings.radius);
  }
  all.settings.clusters = all.clusters.count();
  describe(all.clusters);
  return all;
}

int nearest_cluster(const Clusters& clusters, const MotionFeatures& features) {
  const MotionFeatures point = scaled_features(features);
  int nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < clusters.clusters.size(); ++c) {
    const MotionFeatures centre = scaled_features(clusters.clusters[c].centre);
    double squared = 0.0;
    for (std::size_t k = 0; k < kFeatures; ++k) squared += (point[k] - centre[k]) * (point[k] - centre[k]);
    if (squared < least) nearest = static_cast<int>(c), least = squared;
  }
  return nearest;
}

std::string format_cluster_tree(const Clusters& clusters) {
  std::string out;
  List<int> depth;
  for (const ClusterBranch& branch : clusters.tree) {
    depth.push_back(branch.parent < 0 ? 0 : depth[branch.parent] + 1);
    const std::string indent(2 * static_cast<std::size_t>(depth.back()), ' ');
    const bool leaf = branch.cluster >= 0;
    out += indent + (leaf ? "cluster " + std::to_string(branch.cluster) + ": " : "") +
           counted(branch.motions, "motion") + formatted(", diameter %.2f\n", branch.diameter);
    if (!leaf) continue;
    const MotionCluster& cluster = clusters.clusters[branch.cluster];
    out += indent + "  " + cluster.description + '\n';
    for (const auto& member : cluster.members) out += indent + "  - " + member + '\n';
  }
  return out;
}

std::string format_kind_shares(const Clusters& clusters) {
  List<MotionFeatures> motions;
  for (const MotionCluster& cluster : clusters.clusters)
    motions.insert(motions.end(), cluster.features.begin(), cluster.features.end());
  if (motions.empty()) return "";
  const Array<double, kFeatureKindCount> shares = kind_shares(motions);
  std::string line = "shares of the variance:";
  for (int kind = 0; kind < kFeatureKindCount; ++kind)
    line += (kind > 0 ? ", " : " ") + std::string(kFeatureKinds[kind].name) +
            formatted(" %.1f %%", 100.0 * shares[kind]);
  return line + '\n';
}

std::string format_clusters(const Clusters& clusters) {
  const ClusterConfig& s = clusters.settings;
  record::Json json = {{"settings",
                        {{"radius", s.radius},
                         {"clusters", s.clusters ? record::Json(*s.clusters) : record::Json(nullptr)},
                         {"seed", s.seed}}},
                       {"units", named(clusters.units)},
                       {"tree", record::Json::array()},
                       {"clusters", record::Json::array()}};
  for (const ClusterBranch& b : clusters.tree)
    json["tree"].push_back({{"parent", b.parent},
                            {"cluster", b.cluster < 0 ? record::Json(nullptr) : record::Json(b.cluster)},
                            {"motions", b.motions},
                            {"diameter", b.diameter}});
  for (std::size_t c = 0; c < clusters.clusters.size(); ++c) {
    const MotionCluster& cluster = clusters.clusters[c];
    record::Json one = {{"id", c},
                        {"description", cluster.description},
                        {"diameter", cluster.diameter},
                        {"members", cluster.members},
                        {"centre", named(cluster.centre)}};
    if (!cluster.features.empty()) one["features"] = cluster.features;
    json["clusters"].push_back(std::move(one));
  }
  return record::document(json);
}

void write_clusters(const std::filesystem::path& path, const Clusters& clusters) {
  write_file_atomically(path, format_clusters(clusters));
}

Clusters read_clusters(const std::filesystem::path& path) { return parse_clusters(read_file(path), path); }

Clusters read_clusters(const std::vector<std::filesystem::path>& paths) {
  std::vector<Clusters> parts;
  for (const std::filesystem::path& path : paths) parts.push_back(read_clusters(path));
  return joined(parts);
}

Clusters parse_clusters(const std::string& text, const std::filesystem::path& path) {
  try {
    const record::Json json = record::Json::parse(text);
    Clusters out;
    out.units = unnamed(json.at("units"));
    const record::Json& settings = json.at("settings");
    out.settings.radius = settings.at("radius");
    if (!settings.at("clusters").is_null()) out.settings.clusters = settings.at("clusters").get<int>();
    out.settings.seed = settings.at("seed");
    for (const record::Json& branch : json.at("tree").elements()) out.tree.push_back(branch_of(branch));
    for (const record::Json& cluster : json.at("clusters").elements())
      out.clusters.push_back(cluster_of(cluster));
    if (out.clusters.empty()) throw DataError(path.string(), "clusters", "at least one", "none");
    return out;
  } catch (const record::JsonError& error) {
    throw DataError(path.string(), "", "clusters of motions", error.what());
  }
}

}  // namespace mimicx::pipeline::options
