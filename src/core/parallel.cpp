#include "core/parallel.h"

#include <omp.h>

#include <Eigen/Core>
#include <exception>
#include <vector>

namespace mimicx {

void parallel_for(int chunks, int threads, const std::function<void(int)>& body) {
  std::vector<std::exception_ptr> errors(static_cast<std::size_t>(chunks > 0 ? chunks : 0));
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads > 0 ? threads : 1)
  for (int chunk = 0; chunk < chunks; ++chunk) {
    try {
      body(chunk);
    } catch (...) {
      errors[static_cast<std::size_t>(chunk)] = std::current_exception();
    }
  }
  for (const auto& error : errors)
    if (error) std::rethrow_exception(error);
}

int available_threads() { return omp_get_num_procs(); }

void fix_eigen_blocking() { Eigen::setCpuCacheSizes(32 * 1024, 512 * 1024, 8 * 1024 * 1024); }

namespace {
// A static library's users should not have to remember: the blocking is fixed before main as well.
const bool kBlockingFixed = (fix_eigen_blocking(), true);
}  // namespace

}  // namespace mimicx
