#include "spoolflow/parallel/for_each.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <set>
#include <stdexcept>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

namespace spoolflow::parallel {
namespace {

TEST(ForEach, DoesEveryPieceOnceOnAnyNumberOfThreads) {
  for (const unsigned workers : {0U, 1U, 3U, 50U}) {
    std::vector<int> done(20);
    for_each(done.size(), workers, [&](std::size_t k) { ++done[k]; });
    EXPECT_EQ(done, std::vector<int>(20, 1)) << workers;
  }
  for_each(0, 4, [](std::size_t) { FAIL(); });
}

TEST(ForEach, NeverRunsMoreThreadsThanItMay) {
  std::mutex mutex;
  std::set<std::thread::id> threads;
  for_each(40, 3, [&](std::size_t) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const std::lock_guard lock(mutex);
    threads.insert(std::this_thread::get_id());
  });
  EXPECT_LE(threads.size(), 3U);
}

#if !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)  // the build with sanitizers reserves terabytes, which no limit allows
TEST(ForEach, DoesWithTheThreadsThatTheSystemHas) {
  const auto in_little_memory = [] {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t bytes = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + (rlim_t{40} << 20);  // some stacks
    const struct rlimit limit { bytes, bytes };
    ::setrlimit(RLIMIT_AS, &limit);
    std::atomic<int> done = 0;
    for_each(1000, 100, [&](std::size_t) { ++done; });
    std::_Exit(done == 1000 ? 7 : 1);
  };
  EXPECT_EXIT(in_little_memory(), testing::ExitedWithCode(7), "");
}
#endif

TEST(ForEach, RethrowsAFailureAndLeavesWhatWasNotBegun) {
  std::size_t begun = 0;
  const auto fail_at_two = [&](std::size_t k) {
    ++begun;
    if (k == 2) throw std::runtime_error("piece two");
  };
  EXPECT_THROW(for_each(1000, 1, fail_at_two), std::runtime_error);
  EXPECT_EQ(begun, 3U);
}

}  // namespace
}  // namespace spoolflow::parallel
