#include "spoolflow/parallel/for_each.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace spoolflow::parallel {

unsigned cores() {
  return std::max(1U, std::thread::hardware_concurrency());
}

void for_each(std::size_t count, unsigned workers, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stop{false};
  std::mutex mutex;  // guards failure
  std::exception_ptr failure;
  const auto worker = [&] {
    for (std::size_t k = next++; k < count && !stop; k = next++) {
      try {
        work(k);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        stop = true;
      }
    }
  };
  {
    std::vector<std::jthread> others;  // joined whatever is thrown
    try {
      const std::size_t wanted = std::min<std::size_t>(workers, count);
      if (wanted > 1) others.reserve(wanted - 1);
      while (others.size() + 1 < wanted) others.emplace_back(worker);
    } catch (const std::system_error&) {  // no further thread is to be had, or no memory for it: fewer do the same
    } catch (const std::bad_alloc&) {
    }
    worker();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace spoolflow::parallel
