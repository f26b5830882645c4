/// Arguments that several subcommands share.
#pragma once

#include <cstdint>

#include "arguments.h"
#include "import/motion_file.h"
#include "pipeline/options/clusters.h"

namespace mimicx::tools {

/// --up, --scale, --fps …: how to read the files.
/// @param prepares  the command prepares motions for the simulator: it knows `--scene auto`
void add_read_arguments(Command& command, import::ReadConfig& read, bool prepares = false);

/// --threads; default: all of the machine.
void add_threads(Command& command, int& threads);

/// --force.
void add_force(Command& command, bool& force);

/// --json: a file for the results; "-" is standard output.
void add_json(Command& command, std::filesystem::path& json);

/// --seed; the default is the present value.
void add_seed(Command& command, std::uint64_t& seed);

/// --radius or --clusters.
void add_cluster_arguments(Command& command, pipeline::options::ClusterConfig& clusters);

}  // namespace mimicx::tools
