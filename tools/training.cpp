// plan, imitate, adapt, pretrain and run: the commands that simulate motions.
#include <algorithm>
#include <charconv>
#include <csignal>
#include <iostream>

#include "commands.h"
#include "pipeline/preparation.h"

namespace mimicx {
namespace {

volatile std::sig_atomic_t interrupted = 0;

template <class Config>
void apply(const std::vector<std::string>& settings, Config& config) {
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

/// Runs all inputs in the folder that was named; without one, every input in a folder beside it.
/// @param run  one run with the inputs and the folder that `config` then holds
template <class Config, class Run>
RunOutcome run_inputs(Config& config, const RunContext& context, const Run& run) {
  const std::vector<std::string> files = expand_inputs(config.run.inputs);
  if (!config.run.out.empty()) {
    config.run.inputs = files;
    return run();
  }
  RunOutcome all = RunOutcome::kAllGood;
  config.run.beside = true;
  for (const std::filesystem::path file : files) {
    config.run.inputs = {file.string()};
    config.run.out = file.parent_path() / (file.stem().string() + ".mimicx");
    try {
      const RunOutcome outcome = run();
      if (outcome == RunOutcome::kInterrupted) return outcome;
      if (outcome != RunOutcome::kAllGood) all = outcome;
    } catch (const std::exception& error) {  // its folder cannot be made or read, or holds another run
      context.messages << file.string() << ": left out: " << error.what() << '\n';
      all = RunOutcome::kSomeFailed;
    }
  }
  return all;
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
  throw UsageError(
      "found no data/options beside the program: name trained options with --options, or take --method plan");
}

}  // namespace

int run_imitate(ImitateConfig config, const std::vector<std::string>& settings) {
  apply(settings, config.training);
  return with_context([&](const RunContext& context) {
    return run_inputs(config, context, [&] { return imitate(config, context); });
  });
}

int run_plan(PlanMotionsConfig config, const std::vector<std::string>& settings) {
  config.run.keypoints = config.run.fit;
  apply(settings, config.planning);
  return with_context([&](const RunContext& context) {
    return run_inputs(config, context, [&] { return plan_motions(config, context); });
  });
}

int run_adapt(AdaptConfig config, std::filesystem::path trained, const std::vector<std::string>& settings) {
  config.run.keypoints = config.run.fit;  // a reference that is not on its keypoints contradicts Eq. 3
  if (config.method != AdaptMethod::kPlan)
    config.options = read_options(trained.empty() ? shipped_options() : trained);
  apply(settings, config);
  return with_context([&](const RunContext& context) {
    return run_inputs(config, context, [&] { return adapt(config, context); });
  });
}

int run_pretrain(PretrainConfig config, const std::string& preset, std::optional<std::int64_t> samples,
                 const std::vector<std::string>& settings) {
  const std::uint64_t seed = config.training.seed;
  config.training = pretrain_preset(preset);
  config.training.seed = config.clusters.seed = seed;
  if (samples) config.training.samples = *samples;
  apply(settings, config.training);
  return with_context([&](const RunContext& context) { return pretrain(config, context); });
}

int run_all(const std::filesystem::path& in, const std::filesystem::path& out, PretrainConfig pretraining,
            AdaptConfig adapting, std::optional<std::int64_t> samples) {
  pretraining.inputs = adapting.run.inputs = {in.string()};
  pretraining.out = out / "options";
  adapting.run.out = out / "clean";
  adapting.method = AdaptMethod::kPaper;
  const int status = run_pretrain(pretraining, "small", samples, {});
  if (status == kInterrupted) return status;
  return std::max(status, run_adapt(std::move(adapting), pretraining.out, {}));
}

}  // namespace mimicx
