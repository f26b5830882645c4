#include "core/parallel.h"

#ifdef _OPENMP
#include <omp.h>
#endif

#include <condition_variable>
#include <exception>
#include <mutex>

#include "core/containers.h"

namespace mimicx {
namespace {

// Without OpenMP the compiler ignores the pragmas: the caller does all work, in order.
#ifdef _OPENMP
int this_thread() { return omp_get_thread_num(); }
int processors() { return omp_get_num_procs(); }
#else
int this_thread() { return 0; }
int processors() { return 1; }
#endif

}  // namespace

void parallel_for(int chunks, [[maybe_unused]] int threads, const std::function<void(int)>& body) {
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

namespace {

/// State shared by the workers of a chain.
class Chain {
 public:
  Chain(int n, const std::function<void(int, int)>& item, const std::function<void(int)>& link)
      : n_(n), item_(item), link_(link), ready_(n, false), errors_(n) {}

  void work(int worker) {
    std::unique_lock lock(mutex_);
    while (next_link_ < n_) {
      if (!linking_ && ready_[next_link_]) {
        linking_ = true;
        if (!broken_) call(lock, next_link_, [&] { link_(next_link_); });
        linking_ = false;
        ++next_link_;
      } else if (next_item_ < n_) {
        const int i = next_item_++;
        call(lock, i, [&] { item_(i, worker); });
        ready_[i] = true;
      } else {
        changed_.wait(lock);
        continue;
      }
      changed_.notify_all();
    }
  }
  void rethrow() const {
    for (const auto& error : errors_)
      if (error) std::rethrow_exception(error);
  }

 private:
  /// Calls f without holding the lock.
  template <class F>
  void call(std::unique_lock<std::mutex>& lock, int i, const F& f) {
    lock.unlock();
    std::exception_ptr error;
    try {
      f();
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    if (!error) return;
    errors_[i] = error;
    broken_ = true;
  }

  const int n_;
  const std::function<void(int, int)>& item_;
  const std::function<void(int)>& link_;
  std::mutex mutex_;
  std::condition_variable changed_;
  List<char> ready_;  ///< [n] items that have ended
  List<std::exception_ptr> errors_;
  int next_item_ = 0, next_link_ = 0;
  bool linking_ = false, broken_ = false;
};

}  // namespace

void parallel_chain(int n, [[maybe_unused]] int threads, const std::function<void(int, int)>& item,
                    const std::function<void(int)>& link) {
  Chain chain(n > 0 ? n : 0, item, link);
#pragma omp parallel num_threads(threads > 0 ? threads : 1)
  chain.work(this_thread());
  chain.rethrow();
}

int available_threads() { return processors(); }

}  // namespace mimicx
