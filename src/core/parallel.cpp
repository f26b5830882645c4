#include "core/parallel.h"

#include <omp.h>

#include <exception>

#include "core/containers.h"

namespace mimicx {

void parallel_for(int chunks, int threads, const std::function<void(int)>& body) {
  List<std::exception_ptr> errors(chunks > 0 ? chunks : 0);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads > 0 ? threads : 1)
  for (int chunk = 0; chunk < chunks; ++chunk) {
    try {
      body(chunk);
    } catch (...) {
      errors[chunk] = std::current_exception();
    }
  }
  for (const auto& error : errors)
    if (error) std::rethrow_exception(error);
}

int available_threads() { return omp_get_num_procs(); }

}  // namespace mimicx
