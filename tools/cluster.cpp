#include "motion/prepare/prepare.h"
#include "pipeline/options/clusters.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>

#include "commands.h"
#include "core/error.h"
#include "core/file.h"
#include "files/inputs.h"
#include "program/configurations.h"
#include "record/outputs.h"
#include "run/preparation.h"
#include "shared_arguments.h"
#include "standard_streams.h"

namespace mimicx::tools {
namespace {

struct ClusterArguments {
  std::vector<std::string> inputs;
  std::filesystem::path out, json;
  pipeline::options::ClusterConfig config{program::pretrain_configuration("small").clusters.radius,
                                          std::nullopt, 0};
  import::ReadConfig read;
  bool force = false;
};

/// The given files, and the motions of the given folders, sorted by path.
std::vector<files::MotionInput> sorted_motions(const std::vector<std::string>& names) {
  std::vector<files::MotionInput> inputs = files::find_motions(names, {}, &std::cerr);
  for (files::MotionInput& input : inputs)
    input.path = std::filesystem::path(input.path).lexically_normal().string();
  std::sort(inputs.begin(), inputs.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return inputs;
}

int cluster(const ClusterArguments& a) {
  std::vector<pipeline::options::NamedFeatures> motions;
  const std::vector<files::MotionInput> inputs = sorted_motions(a.inputs);
  const std::vector<std::string> files = files::paths_of(inputs), names = files::unique_names(inputs);
  record::Outputs outputs(files, a.force);
  outputs.claim(a.out, record::kJsonOpening);
  if (!is_standard_output(a.json)) outputs.claim(a.json, record::kJsonOpening);
  if (import::lower_suffix(a.out) != ".json")
    throw UsageError("--out: expected a file that ends in .json, found " + a.out.string());
  bool all_good = true;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string& file = files[i];
    try {
      const motion::Clip clip = import::read_motion(file, a.read);
      run::tell_decisions(file, clip, std::cerr);
      motions.push_back(
          {names[i], pipeline::options::motion_features(motion::prepare_reference(clip, {}, nullptr))});
    } catch (const std::exception& error) {
      std::cerr << file << ": left out: " << reason_of(error) << '\n';
      all_good = false;
    }
  }
  if (motions.empty()) throw std::runtime_error("cluster: no motion to cluster");
  pipeline::options::Clusters clusters;
  try {
    clusters = pipeline::options::cluster_motions(std::move(motions), a.config);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  make_folder(a.out.parent_path());
  pipeline::options::write_clusters(a.out, clusters);
  if (!a.json.empty()) write_json(a.json, read_file(a.out));
  std::fprintf(table_file(a.json), "%zu clusters, no two motions of one farther apart than %.2f\n%s\n%s",
               clusters.clusters.size(), clusters.settings.radius,
               pipeline::options::format_kind_shares(clusters).c_str(),
               pipeline::options::format_cluster_tree(clusters).c_str());
  return all_good ? kAllGood : kSomeFailed;
}

}  // namespace

void declare_cluster(CommandLine& line) {
  const auto a = std::make_shared<ClusterArguments>();
  Command command = line.add("cluster", "Sort motions into clusters of similar ones",
                             "mimicx cluster DIR --out clusters.json                # as many as needed\n"
                             "mimicx cluster DIR --out clusters.json --clusters 5   # exactly five");
  command.files("FILE", a->inputs, "motions and folders of them");
  command.path("--out", a->out, "where to write the clusters: .json").required();
  add_json(command, a->json);
  add_read_arguments(command, a->read);
  add_cluster_arguments(command, a->config);
  add_seed(command, a->config.seed);
  add_force(command, a->force);
  command.action([a] { return cluster(*a); });
}

}  // namespace mimicx::tools
