#include "motion/prepare.h"
#include "pipeline/options/clusters.h"

#include <algorithm>
#include <cstdio>
#include <iostream>

#include "commands.h"
#include "pipeline/preparation.h"
#include "pipeline/record/run_folder.h"

namespace mimicx {
namespace {

/// The files named, and the motions of the folders named, each once and in order of their paths.
std::vector<std::filesystem::path> motion_files(const std::vector<std::string>& inputs) {
  std::vector<std::filesystem::path> files;
  for (const std::string& file : expand_inputs(inputs))
    files.push_back(std::filesystem::path(file).lexically_normal());
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

}  // namespace

int run_cluster(const std::vector<std::string>& inputs, const std::filesystem::path& out,
                const ClusterSettings& settings, const ReadConfig& read) {
  std::vector<NamedFeatures> motions;
  std::vector<std::string> names;
  bool all_good = true;
  for (const auto& file : motion_files(inputs)) {
    names.push_back(unique_name(file, names));
    try {
      const Clip clip = read_motion(file, read);
      tell_decisions(file.string(), clip, std::cerr);
      motions.push_back({names.back(), motion_features(prepare_reference(clip, {}, nullptr))});
    } catch (const std::exception& error) {
      std::cerr << file.string() << ": left out: " << error.what() << '\n';
      all_good = false;
    }
  }
  if (motions.empty()) throw std::runtime_error("cluster: found no motion to cluster");
  Clusters clusters;
  try {
    clusters = cluster_motions(std::move(motions), settings);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  write_clusters(out, clusters);
  std::printf("%zu clusters, no two motions of one farther apart than %.2f\n\n%s", clusters.clusters.size(),
              clusters.settings.radius, format_cluster_tree(clusters).c_str());
  return all_good ? kAllGood : kSomeFailed;
}

}  // namespace mimicx
