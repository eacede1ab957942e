#pragma once
/// Work that falls into pieces, on as many threads as are allowed and no more.
#include <cstddef>
#include <functional>

namespace spoolflow::parallel {

/// Of the machine; one at least.
[[nodiscard]] unsigned cores();

/// Calls `work(index)` for 0 to below `count` on at most `workers` threads, this one among them, in rising order of
/// their beginnings; on fewer where the system has no more. Rethrows the first exception once the others have stopped;
/// what was not begun by then is left. Results must go by index, so that they do not depend on the threads.
void for_each(std::size_t count, unsigned workers, const std::function<void(std::size_t)>& work);

}  // namespace spoolflow::parallel
