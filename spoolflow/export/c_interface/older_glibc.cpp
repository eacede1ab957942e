/// The shared libraries that leave the house are built where the C library is newer than on the machines that load them
/// (2.28 is RHEL 8's, 2.31 that of Debian 11 and Ubuntu 20.04). What the compiler's static libraries ask for of newer
/// ones stands here in terms of what all of them have, hidden from everybody else.
#include <atomic>
#include <cstddef>

#if (defined(__x86_64__) || defined(__aarch64__)) && defined(__GLIBC__)

#define SPOOLFLOW_IN_PLACE_OF(SYMBOL) __asm__(SYMBOL) __attribute__((visibility("hidden")))

extern "C" {

int sched_yield();
int getentropy(void* bytes, std::size_t size);

/// Of glibc 2.32. Zero: there may be threads, so that counts stay atomic.
extern char spoolflow_single_threaded SPOOLFLOW_IN_PLACE_OF("__libc_single_threaded");
char spoolflow_single_threaded = 0;

/// Of glibc 2.33; before, headers made these calls of them, with the version of the structure on this platform.
#ifdef __x86_64__
constexpr int structure_version = 1;
#define SPOOLFLOW_FIRST_GLIBC "GLIBC_2.2.5"
#else
constexpr int structure_version = 0;
#define SPOOLFLOW_FIRST_GLIBC "GLIBC_2.17"
#endif
__asm__(".symver spoolflow_fxstat64, __fxstat64@" SPOOLFLOW_FIRST_GLIBC);
__asm__(".symver spoolflow_xstat, __xstat@" SPOOLFLOW_FIRST_GLIBC);
__asm__(".symver spoolflow_lxstat, __lxstat@" SPOOLFLOW_FIRST_GLIBC);
int spoolflow_fxstat64(int version, int file, void* status);
int spoolflow_xstat(int version, const char* path, void* status);
int spoolflow_lxstat(int version, const char* path, void* status);
int spoolflow_fstat64(int file, void* status) SPOOLFLOW_IN_PLACE_OF("fstat64");
int spoolflow_fstat64(int file, void* status) {
  return spoolflow_fxstat64(structure_version, file, status);
}
int spoolflow_fstat(int file, void* status) SPOOLFLOW_IN_PLACE_OF("fstat");  // of the same structure
int spoolflow_fstat(int file, void* status) {
  return spoolflow_fxstat64(structure_version, file, status);
}
int spoolflow_stat(const char* path, void* status) SPOOLFLOW_IN_PLACE_OF("stat");
int spoolflow_stat(const char* path, void* status) {
  return spoolflow_xstat(structure_version, path, status);
}
int spoolflow_lstat(const char* path, void* status) SPOOLFLOW_IN_PLACE_OF("lstat");
int spoolflow_lstat(const char* path, void* status) {
  return spoolflow_lxstat(structure_version, path, status);
}

/// In the C library proper from 2.34 on, before that in libpthread, which a program in C may not have loaded.
int spoolflow_once(int* control, void (*init)()) SPOOLFLOW_IN_PLACE_OF("pthread_once");
int spoolflow_once(int* control, void (*init)()) {
  constexpr int fresh = 0, running = 1, done = 2;
  std::atomic_ref<int> state(*control);
  int before = fresh;
  if (state.compare_exchange_strong(before, running, std::memory_order_acquire)) {
    init();
    state.store(done, std::memory_order_release);
    return 0;
  }
  while (state.load(std::memory_order_acquire) != done) sched_yield();
  return 0;
}

/// Asked for by what ends threads where the C library has no __cxa_thread_atexit_impl; all of these have it.
int spoolflow_key_create(unsigned* key, void (*end)(void*)) SPOOLFLOW_IN_PLACE_OF("__pthread_key_create");
int spoolflow_key_create(unsigned* /*key*/, void (* /*end*/)(void*)) {
  constexpr int no_more_keys = 11;  // EAGAIN
  return no_more_keys;
}

/// Of glibc 2.36. Asked for by the library's random device, which nothing here uses.
unsigned spoolflow_random() SPOOLFLOW_IN_PLACE_OF("arc4random");
unsigned spoolflow_random() {
  unsigned bits = 0;
  return getentropy(&bits, sizeof bits) == 0 ? bits : 0;
}

/// Of glibc 2.38, for C23, which also reads binary numbers; headers turn calls of the older ones into calls of these.
unsigned long spoolflow_older_strtoul(const char* text, char** end, int base) __asm__("strtoul");
unsigned long spoolflow_strtoul(const char* text, char** end, int base) SPOOLFLOW_IN_PLACE_OF("__isoc23_strtoul");
unsigned long spoolflow_strtoul(const char* text, char** end, int base) {
  return spoolflow_older_strtoul(text, end, base);
}
long long spoolflow_older_strtoll(const char* text, char** end, int base) __asm__("strtoll");
long long spoolflow_strtoll(const char* text, char** end, int base) SPOOLFLOW_IN_PLACE_OF("__isoc23_strtoll");
long long spoolflow_strtoll(const char* text, char** end, int base) {
  return spoolflow_older_strtoll(text, end, base);
}
unsigned long long spoolflow_older_strtoull(const char* text, char** end, int base) __asm__("strtoull");
unsigned long long spoolflow_strtoull(const char* text, char** end, int base)
    SPOOLFLOW_IN_PLACE_OF("__isoc23_strtoull");
unsigned long long spoolflow_strtoull(const char* text, char** end, int base) {
  return spoolflow_older_strtoull(text, end, base);
}

}  // extern "C"

#endif
