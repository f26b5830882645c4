#include <cstdio>
#include <cstdlib>

#include "core/error.h"
#include "machine.h"

void Counted::begin() {}
void Counted::end() {}
void print_counts(const Counted&, const Counted&, int) {}

#ifndef __cpp_exceptions
void mimicx::stop(const char* message) {
  std::fprintf(stderr, "%s\n", message);
  std::exit(1);
}
#endif
