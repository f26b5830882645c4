#include "pipeline/imitate.h"

#include <charconv>
#include <csignal>
#include <iostream>

#include "commands.h"

namespace mimicx {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void apply(const std::string& setting, TrainingConfig& config) {
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

}  // namespace

int run_imitate(ImitateOptions options, const std::vector<std::string>& settings) {
  for (const auto& setting : settings) apply(setting, options.training);
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

}  // namespace mimicx
