// parallel.h for a bare build: one thread, everything in order.
#include "core/parallel.h"

namespace mimicx {

void parallel_for(int chunks, int, const std::function<void(int)>& body) {
  for (int chunk = 0; chunk < chunks; ++chunk) body(chunk);
}

void parallel_chain(int n, int, const std::function<void(int, int)>& item,
                    const std::function<void(int)>& link) {
  for (int i = 0; i < n; ++i) {
    item(i, 0);
    link(i);
  }
}

int available_threads() { return 1; }

}  // namespace mimicx
