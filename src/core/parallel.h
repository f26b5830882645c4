/// The only place where threads start.
///
/// The number of chunks never depends on the number of threads, each chunk writes to its own memory, and
/// reductions run over the chunks in order afterwards. Therefore one and two threads give the same bytes.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace mimicx {

/// Chunk k of n nearly equal ones, in order.
inline std::span<const int> part(std::span<const int> all, std::size_t k, std::size_t n) {
  const std::size_t begin = all.size() * k / n;
  return all.subspan(begin, all.size() * (k + 1) / n - begin);
}

/// Calls body(chunk) for chunk = 0 .. chunks-1 on up to `threads` threads, in no particular order.
/// If chunks throw, the exception of the lowest one is rethrown after every chunk has ended.
void parallel_for(int chunks, int threads, const std::function<void(int chunk)>& body);

/// Calls item(i, worker) for i = 0 .. n-1 on up to `threads` threads, and link(i) for i = 0 .. n-1 in order,
/// one at a time, each after item(i) and link(i-1). The links, a sequential chain, run concurrently with
/// later items. item(i) and link(i) may run on different threads.
/// @param item  worker: 0 .. threads-1, for scratch; no two items of a worker run at once
/// If items throw, no later link begins, and the exception of the lowest item is rethrown after every item
/// has ended.
void parallel_chain(int n, int threads, const std::function<void(int i, int worker)>& item,
                    const std::function<void(int i)>& link);

/// Number of processors this process may use.
int available_threads();

}  // namespace mimicx
