#include "spoolflow/recording/files/few_rights.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fcntl.h>
#include <fstream>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
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

#if defined(__x86_64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t architecture = 0;
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
constexpr std::array<std::uint32_t, 27> allowed_calls{
    SYS_read,   SYS_pread64, SYS_readv,      SYS_write,          SYS_writev,       SYS_lseek,         SYS_close,
    SYS_fstat,  SYS_fcntl,   SYS_newfstatat, SYS_mmap,           SYS_munmap,       SYS_mprotect,      SYS_mremap,
    SYS_brk,    SYS_madvise, SYS_futex,      SYS_rt_sigprocmask, SYS_rt_sigreturn, SYS_clock_gettime, SYS_getrandom,
    SYS_sendto, SYS_getpid,  SYS_gettid,     SYS_sched_yield,    SYS_exit,         SYS_exit_group};

/// Fails with EPERM what is not allowed. Its jumps count the instructions to step over.
void allow_only_reading() {
  constexpr std::size_t calls = allowed_calls.size();
  std::array<sock_filter, calls + 6> filter{};
  const auto at = [](std::size_t offset) { return static_cast<std::uint32_t>(offset); };
  filter[0] = BPF_STMT(BPF_LD | BPF_W | BPF_ABS, at(offsetof(seccomp_data, arch)));
  filter[1] = BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0);
  filter[2] = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL);
  filter[3] = BPF_STMT(BPF_LD | BPF_W | BPF_ABS, at(offsetof(seccomp_data, nr)));
  for (std::size_t k = 0; k < calls; ++k) {
    filter[4 + k] = BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, allowed_calls[k], static_cast<unsigned char>(calls - k), 0);
  }
  filter[4 + calls] = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | 1U);
  filter[5 + calls] = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  (void)::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
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
  std::sort(descriptors.begin(), descriptors.end());
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
  if (architecture != 0) allow_only_reading();
}

}  // namespace spoolflow::recording
