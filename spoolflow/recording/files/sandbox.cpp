#include "spoolflow/recording/files/sandbox.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <fstream>
#include <memory>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__)
#define SPOOLFLOW_SANITIZED_READING 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SPOOLFLOW_SANITIZED_READING 1
#endif
#endif

namespace spoolflow::recording {
namespace {

#ifdef SPOOLFLOW_SANITIZED_READING
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

#if defined(SPOOLFLOW_SANITIZED_READING) && !defined(FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION)
constexpr bool silent = false;  // what a sanitizer finds in the child is to be read
#else
constexpr bool silent = true;
#endif

/// Never above what the process may have already. `spare`: from the signal to the end.
template <class Resource>
void limit(Resource resource, std::uint64_t wanted, std::uint64_t spare = 0) {
  struct rlimit now {};
  if (::getrlimit(resource, &now) != 0) return;
  const struct rlimit limited {
    std::min<rlim_t>(wanted, now.rlim_cur), std::min<rlim_t>(wanted + spare, now.rlim_max)
  };
  (void)::setrlimit(resource, &limited);
}

/// Address space that the process has [bytes].
std::uint64_t address_space() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// What stays allowed: reading and writing what is open, memory, time, the end.
constexpr std::array<int, 27> allowed_calls{
    SCMP_SYS(read),      SCMP_SYS(pread64),   SCMP_SYS(readv),          SCMP_SYS(write),        SCMP_SYS(writev),
    SCMP_SYS(lseek),     SCMP_SYS(close),     SCMP_SYS(fstat),          SCMP_SYS(fcntl),        SCMP_SYS(newfstatat),
    SCMP_SYS(mmap),      SCMP_SYS(munmap),    SCMP_SYS(mprotect),       SCMP_SYS(mremap),       SCMP_SYS(brk),
    SCMP_SYS(madvise),   SCMP_SYS(futex),     SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn), SCMP_SYS(clock_gettime),
    SCMP_SYS(getrandom), SCMP_SYS(sendto),    SCMP_SYS(getpid),         SCMP_SYS(gettid),       SCMP_SYS(sched_yield),
    SCMP_SYS(exit),      SCMP_SYS(exit_group)};

/// Fails with EPERM what is not allowed; a call of another architecture ends the process.
void allow_only_reading() {
  const std::unique_ptr<void, decltype(&::seccomp_release)> filter(::seccomp_init(SCMP_ACT_ERRNO(EPERM)),
                                                                   &::seccomp_release);
  if (!filter) return;
  for (const int call : allowed_calls) (void)::seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, call, 0);
  (void)::seccomp_load(filter.get());
}

}  // namespace

ReadingLimits reading_limits(std::uint64_t file_bytes) {
  constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20;
  return {512 * mebibyte + 250 * file_bytes, 20 + 2 * (file_bytes / mebibyte)};
}

void keep_only(std::array<int, 2> descriptors) {
  const int nothing = ::open("/dev/null", O_RDWR);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO}) (void)::dup2(nothing, standard);
  if (silent) (void)::dup2(nothing, STDERR_FILENO);
  std::ranges::sort(descriptors);
  unsigned next = STDERR_FILENO + 1;
  for (const int kept : descriptors) {
    if (kept <= STDERR_FILENO) continue;
    const auto descriptor = static_cast<unsigned>(kept);
    if (descriptor > next) (void)::close_range(next, descriptor - 1, 0);
    next = descriptor + 1;
  }
  (void)::close_range(next, ~0U, 0);
}

void give_up_rights(const ReadingLimits& limits) {
  if (!sanitized) limit(RLIMIT_AS, address_space() + limits.memory_bytes);
  limit(RLIMIT_CPU, limits.computing_s, 2);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_NPROC, 0);
  (void)::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
}

void give_up_opening() {
  if (sanitized) return;  // the sanitizers open pipes to look at memory
  limit(RLIMIT_NOFILE, 0);
  allow_only_reading();
}

}  // namespace spoolflow::recording
