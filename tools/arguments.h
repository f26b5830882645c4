/// Arguments that several subcommands share.
#pragma once

#include <cstdint>
#include <string>

#include "motion/import/motion_file.h"
#include "pipeline/options/clusters.h"

namespace CLI {
class App;
}

namespace mimicx::tools {

/// --up, --scale, --fps …: what the user knows better than the files.
void add_read_arguments(CLI::App& command, motion::import::ReadConfig& read);

/// --threads; default: all there are.
void add_threads(CLI::App& command, int& threads);

/// A whole number that must not be negative. Both return what is wrong with it, or nothing.
std::string refuse_negative(const std::string& number);
/// A path that must not be the empty text.
std::string refuse_empty_path(const std::string& path);

/// --force.
void add_force(CLI::App& command, bool& force);

/// A longer description in the command's own help than in the list of commands.
void set_own_help(CLI::App& command, const std::string& help);

/// --seed; the default is the value that is there.
void add_seed(CLI::App& command, std::uint64_t& seed);

/// --radius or --clusters.
void add_cluster_arguments(CLI::App& command, pipeline::options::ClusterConfig& clusters);

}  // namespace mimicx::tools
