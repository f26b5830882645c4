#include "pipeline/imitate.h"

#include <charconv>
#include <csignal>
#include <iostream>
#include <memory>

#include "commands.h"
#include "core/parallel.h"

namespace mimicx {
namespace {

constexpr int kInterrupted = 130;  // as shells report an interrupt

volatile std::sig_atomic_t interrupted = 0;

int run_imitate(const ImitateOptions& options) {
  // The first interrupt asks for a checkpoint, a second one ends the program at once.
  const auto handle = [](int signal) {
    interrupted = 1;
    std::signal(signal, SIG_DFL);
  };
  std::signal(SIGINT, handle);
  std::signal(SIGTERM, handle);
  Progress progress(std::cerr, stderr_is_terminal(), steady_seconds);
  const ImitateContext context = {progress, std::cerr, [] { return interrupted != 0; }};
  try {
    switch (imitate(options, context)) {
      case ImitateOutcome::kAllGood:
        return kAllGood;
      case ImitateOutcome::kSomeFailed:
        return kSomeFailed;
      case ImitateOutcome::kInterrupted:
        return kInterrupted;
    }
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  return kSomeFailed;
}

void set(const std::vector<std::string>& settings, TrainingConfig& config) {
  for (const std::string& setting : settings) {
    const auto equals = setting.find('=');
    double value = 0.0;
    const char* end = setting.data() + setting.size();
    if (equals == std::string::npos || std::from_chars(setting.data() + equals + 1, end, value).ptr != end ||
        equals + 1 == setting.size())
      throw CLI::ValidationError("--set", "expected NAME=NUMBER, found '" + setting + "'");
    try {
      apply_setting(config, setting.substr(0, equals), value);
    } catch (const std::invalid_argument& error) {
      throw CLI::ValidationError("--set", setting + ": " + error.what());
    }
  }
}

}  // namespace

void add_imitate(CLI::App& app, Run& run) {
  auto* command = app.add_subcommand("imitate", "Train a simulated character to follow each motion");
  const auto options = std::make_shared<ImitateOptions>();
  options->threads = available_threads();
  command->add_option("FILE", options->inputs, "motions: AMASS-style .npz")->required();
  command->add_option("--out", options->out, "folder of the run; the same command continues what is there")
      ->required();
  command
      ->add_option("--samples", options->training.samples, "training budget per motion, in character steps")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--seed", options->training.seed, "root of every random number")->capture_default_str();
  command->add_option("--threads", options->threads, "worker threads; no influence on the results")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command
      ->add_option(
          "--limit-seconds", options->limit_seconds,
          "safety stop per motion: ends its training early, makes the result depend on the machine, and is "
          "recorded as such")
      ->check(CLI::PositiveNumber);
  command
      ->add_option_function<std::vector<std::string>>(
          "--set", [options](const std::vector<std::string>& settings) { set(settings, options->training); },
          "NAME=VALUE: change a setting by the name it has in the manifest, for experiments; repeatable")
      ->take_all();
  command->callback([&run, options] { run = [options] { return run_imitate(*options); }; });
}

}  // namespace mimicx
