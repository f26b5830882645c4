// imitate, adapt, pretrain and run: the commands that train.
#include <algorithm>
#include <charconv>
#include <csignal>
#include <iostream>

#include "commands.h"
#include "pipeline/preparation.h"

namespace mimicx {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void apply(const std::vector<std::string>& settings, TrainingConfig& config) {
  for (const std::string& setting : settings) {
    const auto equals = setting.find('=');
    double value = 0.0;
    const char* end = setting.data() + setting.size();
    if (equals == std::string::npos || equals + 1 == setting.size() ||
        std::from_chars(setting.data() + equals + 1, end, value).ptr != end)
      throw UsageError("--set: expected NAME=NUMBER, found '" + setting + "'");
    try {
      apply_setting(config, setting.substr(0, equals), value);
    } catch (const std::invalid_argument& error) {
      throw UsageError("--set " + setting + ": " + error.what());
    }
  }
  try {
    check(config);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--set: ") + error.what());
  }
}

/// The first interrupt asks for a checkpoint, a second one ends the program at once.
void catch_interrupts() {
  const auto handle = [](int signal) {
    interrupted = 1;
    std::signal(signal, SIG_DFL);
  };
  std::signal(SIGINT, handle);
  std::signal(SIGTERM, handle);
}

int status_of(RunOutcome outcome) {
  switch (outcome) {
    case RunOutcome::kAllGood:
      return kAllGood;
    case RunOutcome::kSomeFailed:
      return kSomeFailed;
    case RunOutcome::kInterrupted:
      return kInterrupted;
  }
  return kSomeFailed;
}

/// Calls work(context) with progress on standard error; what the command line got wrong is wrong usage.
template <class Work>
int with_context(const Work& work) {
  catch_interrupts();
  Progress progress(std::cerr, stderr_is_terminal(), steady_seconds);
  try {
    return status_of(work(RunContext{progress, std::cerr, [] { return interrupted != 0; }}));
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

/// data/options of the source tree that holds this program, or of the folder it was started in.
std::filesystem::path shipped_options() {
  const std::filesystem::path relative = std::filesystem::path("data") / "options";
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  for (std::filesystem::path at = program.parent_path(); !error && at != at.root_path();
       at = at.parent_path())
    if (std::filesystem::exists(at / relative / "options.npz")) return at / relative;
  if (std::filesystem::exists(relative / "options.npz")) return relative;
  throw UsageError("found no data/options beside the program: name trained options with --options");
}

}  // namespace

int run_imitate(RunOptions options, const std::vector<std::string>& settings) {
  apply(settings, options.training);
  return with_context([&](const RunContext& context) {
    const std::vector<std::string> files = expand_inputs(options.inputs);
    if (!options.out.empty()) {
      options.inputs = files;
      return run_sequences(options, context);
    }
    RunOutcome all = RunOutcome::kAllGood;
    options.beside = true;
    for (const std::filesystem::path file : files) {
      options.inputs = {file.string()};
      options.out = file.parent_path() / (file.stem().string() + ".mimicx");
      try {
        const RunOutcome outcome = run_sequences(options, context);
        if (outcome == RunOutcome::kInterrupted) return outcome;
        if (outcome != RunOutcome::kAllGood) all = outcome;
      } catch (const std::exception& error) {  // its folder cannot be made or read, or holds another run
        context.messages << file.string() << ": left out: " << error.what() << '\n';
        all = RunOutcome::kSomeFailed;
      }
    }
    return all;
  });
}

int run_adapt(RunOptions options, std::filesystem::path trained, const std::vector<std::string>& settings) {
  options.keypoints = options.fit;  // a reference that is not on its keypoints contradicts Eq. 3
  if (trained.empty()) trained = shipped_options();
  options.options = read_options(trained);
  return run_imitate(std::move(options), settings);
}

int run_pretrain(PretrainOptions options, const std::string& preset, std::optional<std::int64_t> samples,
                 const std::vector<std::string>& settings) {
  const std::uint64_t seed = options.training.seed;
  options.training = pretrain_preset(preset);
  options.training.seed = options.clusters.seed = seed;
  if (samples) options.training.samples = *samples;
  apply(settings, options.training);
  return with_context([&](const RunContext& context) { return pretrain(options, context); });
}

int run_all(const std::filesystem::path& in, const std::filesystem::path& out, PretrainOptions options,
            RunOptions adapt, std::optional<std::int64_t> samples) {
  options.inputs = adapt.inputs = {in.string()};
  options.out = out / "options";
  adapt.out = out / "clean";
  const int status = run_pretrain(options, "small", samples, {});
  if (status == kInterrupted) return status;
  return std::max(status, run_adapt(std::move(adapt), options.out, {}));
}

}  // namespace mimicx
