/// The subcommands of `mimicx`, one file each: what the command line asks for, and the work.
///
/// mimicx.cpp declares the options and calls these. Each returns the exit status. A command prints results on
/// standard output, progress and complaints on standard error.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "motion/fit/fit.h"
#include "motion/synth/set.h"
#include "pipeline/adapt.h"
#include "pipeline/imitate.h"
#include "pipeline/options/clusters.h"
#include "pipeline/plan.h"
#include "pipeline/pretrain.h"

namespace mimicx {

inline constexpr int kAllGood = 0;
inline constexpr int kSomeFailed = 1;
inline constexpr int kWrongUsage = 2;
inline constexpr int kInterrupted = 130;  ///< as shells report an interrupt

/// The command line asks for something that cannot be: exit status 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// @param settings  NAME=NUMBER each: settings to change, by their names in the manifest
int run_plan(PlanMotionsConfig config, const std::vector<std::string>& settings);
int run_imitate(ImitateConfig config, const std::vector<std::string>& settings);
/// Without a folder in `config.run.out`, every input gets one beside it (NAME.mimicx) and its clean motion
/// beside it (NAME.clean.EXT). @param trained  options to start from: a file, or a folder with options.npz;
/// empty: those in data/options
int run_adapt(AdaptConfig config, std::filesystem::path trained, const std::vector<std::string>& settings);
/// @param samples  of all options together; none: what the preset says
int run_pretrain(PretrainConfig config, const std::string& preset, std::optional<std::int64_t> samples,
                 const std::vector<std::string>& settings);
/// All stages: pretrain on a folder, then adapt all of it. @param samples  of the pre-training
int run_all(const std::filesystem::path& in, const std::filesystem::path& out, PretrainConfig pretraining,
            AdaptConfig adapting, std::optional<std::int64_t> samples);
/// @param motions  one folder: every motion and their mean; several: a row of means per folder
/// @param json  where to write every value as well; empty: nowhere
int run_evaluate(const std::filesystem::path& truth, const std::vector<std::string>& motions,
                 const std::filesystem::path& json);
/// @param inputs  files, and folders of motion files
int run_cluster(const std::vector<std::string>& inputs, const std::filesystem::path& out,
                const ClusterSettings& settings, const ReadConfig& read);
/// @param inputs  files, and folders of motion files; the fitted motions get their names
int run_fit(const std::vector<std::string>& inputs, const std::filesystem::path& out, const FitConfig& config,
            const ReadConfig& read);
int run_info(const std::filesystem::path& file, const ReadConfig& read);
/// @param fps  of the output; 0: the input's
int run_convert(const std::filesystem::path& in, const std::filesystem::path& out, const ReadConfig& read,
                double fps);
/// @param inputs  motions, physics steps, and folders of them
/// @param poses_alone  look at the poses only, whatever a motion holds besides
/// @param json  where to write every row as well; empty: nowhere
int run_audit(const std::vector<std::string>& inputs, bool poses_alone, const std::filesystem::path& json);
/// @param betas   at most 10, the others are 0; not looked at where there is a motion
/// @param motion  whose body to take; empty: none
int run_export_mjcf(const std::vector<double>& betas, const std::filesystem::path& motion,
                    const ReadConfig& read, const std::filesystem::path& out);

struct SynthArguments {
  std::filesystem::path out;  ///< folder of a set; empty: none is written
  std::filesystem::path
      data_set;  ///< folder that gets the project's own test and training split; empty: none
  SynthSetConfig set;
  bool report = false;  ///< print what each motion of the set demands of a body
};
int run_synth(const SynthArguments& arguments);

}  // namespace mimicx
