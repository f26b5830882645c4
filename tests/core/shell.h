/// Runs other programs through a shell.
#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace mimicx {

struct Call {
  int status;
  std::string text;  ///< both streams
};

/// Runs a command line in a shell.
inline Call shell(const std::string& line) {
  FILE* pipe = popen(line.c_str(), "r");
  Call call{-1, {}};
  char buffer[4096];
  while (const std::size_t n = fread(buffer, 1, sizeof buffer, pipe)) call.text.append(buffer, n);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) call.status = WEXITSTATUS(status);
  return call;
}

}  // namespace mimicx
