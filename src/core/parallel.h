/// The only place where threads start.
///
/// Work is cut into chunks whose number never depends on the thread count, each chunk writes its own
/// place, and reductions run over the chunks in order afterwards: that is what makes one and two
/// threads give the same bytes.
#pragma once

#include <functional>

namespace mimicx {

/// Calls body(chunk) for chunk = 0 .. chunks-1 on up to `threads` threads, in no particular order.
/// An exception leaves the region only after every chunk has ended; the one of the lowest chunk is
/// rethrown.
void parallel_for(int chunks, int threads, const std::function<void(int chunk)>& body);

/// Number of processors this process may use.
int available_threads();

}  // namespace mimicx
