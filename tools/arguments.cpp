#include "arguments.h"

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "core/parallel.h"

namespace mimicx::tools {

void add_read_arguments(CLI::App& command, motion::import::ReadConfig& read) {
  static const std::map<std::string, char> kAxes = {{"x", 'x'},  {"y", 'y'},  {"z", 'z'},
                                                    {"-x", 'X'}, {"-y", 'Y'}, {"-z", 'Z'}};
  command
      .add_option_function<std::string>(
          "--up", [&read](const std::string& axis) { read.up = kAxes.at(axis); },
          "the axis that points up in the files; default: looked for")
      ->check(CLI::IsMember(kAxes));
  command.add_option("--scale", read.scale, "metres per unit of length in the files; default: looked for")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--fps", read.fps, "frame rate the motions were recorded at; default: what the files say")
      ->check(CLI::Range(0.1, 2000.0));
  command.add_option("--floor", read.floor,
                     "height of the floor in the files, m, z up; default: where the motion stands");
  command
      .add_option_function<std::string>(
          "--body", [&read](const std::string& body) { read.standard_body = body == "standard"; },
          "file (default): the body shape of the file, where it is known; standard: the standard body")
      ->check(CLI::IsMember({"file", "standard"}));
  command.add_option("--smplx", read.smplx, "your SMPLX_NEUTRAL.npz: gives SMPL-X betas their joints")
      ->check(CLI::ExistingFile);
  command
      .add_option("--joint-map", read.joint_map,
                  "more joint names for BVH skeletons: a text file, docs/formats.md")
      ->check(CLI::ExistingFile);
}

void add_threads(CLI::App& command, int& threads) {
  threads = available_threads();
  command.add_option("--threads", threads, "worker threads; no influence on the results")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

std::string refuse_negative(const std::string& number) {
  return number.starts_with('-') ? "expected a number from 0 on, found " + number : std::string();
}

std::string refuse_empty_path(const std::string& path) {
  return path.empty() ? "expected a path, found nothing" : std::string();
}

void add_force(CLI::App& command, bool& force) {
  command.add_flag("--force", force, "overwrite files that this program did not make; inputs never");
}

void set_own_help(CLI::App& command, const std::string& help) {
  command.preparse_callback([&command, help](std::size_t) { command.description(help); });
}

void add_seed(CLI::App& command, std::uint64_t& seed) {
  command.add_option("--seed", seed, "root of every random number")
      ->check(refuse_negative)
      ->capture_default_str();
}

void add_cluster_arguments(CLI::App& command, pipeline::options::ClusterConfig& clusters) {
  auto* radius =
      command
          .add_option("--radius", clusters.radius, "no two motions of a cluster are farther apart than this")
          ->check(CLI::NonNegativeNumber)
          ->capture_default_str();
  command.add_option("--clusters", clusters.clusters, "how many clusters to make instead")
      ->check(CLI::PositiveNumber)
      ->excludes(radius);
}

}  // namespace mimicx::tools
