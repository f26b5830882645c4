/// The only place where threads start.
///
/// Work is cut into chunks whose number never depends on the thread count, each chunk writes its own
/// place, and reductions run over the chunks in order afterwards: that is what makes one and two
/// threads give the same bytes.
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
/// An exception leaves the region only after every chunk has ended; the one of the lowest chunk is
/// rethrown.
void parallel_for(int chunks, int threads, const std::function<void(int chunk)>& body);

/// Calls item(i, worker) for i = 0 .. n-1 on up to `threads` threads, and link(i) for i = 0 .. n-1 in this
/// order, one at a time: after item(i) and link(i-1). So a chain of steps runs beside the work that the later
/// ones need. Where a link follows its item closely, both may be on different threads.
/// @param item  worker: 0 .. threads-1, for scratch; no two items of a worker run at once
/// An exception leaves the region after every item has ended; no link behind it begins. That of the lowest
/// item is rethrown.
void parallel_chain(int n, int threads, const std::function<void(int i, int worker)>& item,
                    const std::function<void(int i)>& link);

/// Number of processors this process may use.
int available_threads();

}  // namespace mimicx
