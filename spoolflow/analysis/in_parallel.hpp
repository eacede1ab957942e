#pragma once
#include <cstddef>
#include <functional>

namespace spoolflow::analysis {

/// Calls `work(index)` for 0 to below `count` on `workers` threads. Rethrows the first exception once the others have
/// stopped. Results must go by index, so that they do not depend on the threads.
void in_parallel(std::size_t count, unsigned workers, const std::function<void(std::size_t)>& work);

}  // namespace spoolflow::analysis
