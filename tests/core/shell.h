/// Runs other programs through a shell, and searches what they print.
#pragma once

#include <regex.h>
#include <sys/wait.h>

#include <cstdio>
#include <stdexcept>
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

/// The first match of an extended regular expression (POSIX) in a text; empty: there is none. The standard
/// library's take three seconds to compile.
inline std::string first_match(const std::string& text, const std::string& expression) {
  regex_t compiled;
  if (regcomp(&compiled, expression.c_str(), REG_EXTENDED) != 0) throw std::invalid_argument(expression);
  regmatch_t found;
  const bool any = regexec(&compiled, text.c_str(), 1, &found, 0) == 0;
  regfree(&compiled);
  return any ? text.substr(static_cast<std::size_t>(found.rm_so),
                           static_cast<std::size_t>(found.rm_eo - found.rm_so))
             : "";
}

}  // namespace mimicx
