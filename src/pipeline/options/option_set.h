/// A set of options in one file: the policies, their encoders, and the clusters they were trained on.
///
/// `mimicx pretrain` writes `options.npz`; `mimicx adapt` reads it. Weights are 32-bit floats; optimiser
/// states are not part of it. Members: options.count, optionK.agent.*, optionK.encoder.*,
/// optionK.description, optionK.centre (features, SI units), optionK.motions, optionK.samples; and
/// options.absolute_actions, options.no_feed_forward and options.no_ramp, 1, each only if it is so; and
/// options.max_action, rad, only if it is not the default.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/containers.h"
#include "core/npz/npz.h"
#include "pipeline/options/features.h"
#include "pipeline/options/option.h"

namespace mimicx::pipeline::options {

struct TrainedOption {
  Option option;
  std::string description;  ///< of its motions, in words
  MotionFeatures centre{};  ///< of its cluster
  int motions = 0;          ///< number of motions it was trained on
  std::int64_t samples = 0;
};

struct OptionSet {
  List<TrainedOption> options;
  rl::tracking::ActionSettings actions;  ///< of all policies
  std::string checksum;                  ///< of the file; empty if it was not read from one
  std::filesystem::path clusters;        ///< `clusters.json` beside that file; empty if missing
};

/// Sets in the order in which they are tried. Their options are numbered consecutively over all sets.
using OptionSets = List<std::shared_ptr<const OptionSet>>;
/// Number of a set's first option.
int first_option(const OptionSets& sets, int set);
/// Of all sets, in their order.
std::string checksum_of(const OptionSets& sets);

void write_options(const std::filesystem::path& path, const OptionSet& set);
/// @param path  the file, or a folder that holds `options.npz`
/// @throws DataError for a file without options, and for options that do not fit this program's states and
/// actions
std::shared_ptr<const OptionSet> read_options(const std::filesystem::path& path);
/// The same from an archive; without a checksum.
OptionSet options_from(const Npz& archive);
/// "residual_actions=1, velocity_feed_forward=1, target_ramp=1"; max_action only if it is not the default.
std::string actions_in_words(const rl::tracking::ActionSettings& actions);

}  // namespace mimicx::pipeline::options
