#include "interrupts.h"

#include <csignal>

#include "core/file.h"

namespace mimicx::tools {
namespace {

volatile std::sig_atomic_t was_interrupted = 0;

/// Removes unfinished files, then ends the program as the signal does by itself.
void end_by(int signal) {
  remove_unfinished_files();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void handle_signals() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, end_by);
}

void catch_interrupts() {
  const auto handle = [](int signal) {
    was_interrupted = 1;
    std::signal(signal, end_by);
  };
  std::signal(SIGINT, handle);
  std::signal(SIGTERM, handle);
}

bool interrupted() { return was_interrupted != 0; }

}  // namespace mimicx::tools
