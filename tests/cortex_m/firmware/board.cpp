#include "board.hpp"

extern "C" {
extern std::uint32_t stored_data[], first_data[], last_data[], first_bss[], last_bss[], stack_top[];
extern void (*first_initialiser[])();
extern void (*last_initialiser[])();
int main();

[[noreturn]] void reset() {
#ifdef __ARM_FP
  // Coprocessors 10 and 11 are the floating-point unit; before anything may use it.
  *reinterpret_cast<volatile std::uint32_t*>(0xE000ED88U) |= 0xFU << 20U;
  __asm__ volatile("dsb\n isb" ::: "memory");
#endif
  const std::uint32_t* from = stored_data;
  for (volatile std::uint32_t* to = first_data; to != last_data; ++to) *to = *from++;
  for (volatile std::uint32_t* to = first_bss; to != last_bss; ++to) *to = 0;
  for (auto* initialise = first_initialiser; initialise != last_initialiser; ++initialise) (*initialise)();
  board::exit(static_cast<std::uint32_t>(main()));
}

[[noreturn]] void fault() {
  board::print("fault\n");
  board::exit(99);
}
}

namespace {

using Handler = void (*)();
struct Vectors {
  std::uint32_t* stack;
  Handler handlers[15];
};
[[gnu::section(".isr_vector"), gnu::used]] const Vectors vectors{
    stack_top,
    {reset, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault}};

constexpr std::uint32_t pattern = 0xA5A5A5A5U;
constexpr std::uint32_t painted_words = 2048;

std::uint32_t ask_host(std::uint32_t operation, const void* argument) {
  register std::uint32_t r0 __asm__("r0") = operation;
  register const void* r1 __asm__("r1") = argument;
  __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

std::uint32_t* painted_from = nullptr;

}  // namespace

namespace board {

void print(const char* text) {
  ask_host(0x04, text);
}

void print(const char* name, std::uint32_t number) {
  char digits[12] = "          \n";
  char* first = digits + 10;
  do {
    *--first = static_cast<char>('0' + number % 10U);
    number /= 10U;
  } while (number != 0U);
  print(name);
  print(" ");
  print(first);
}

HostFile::HostFile(const char* name, Mode mode) : handle_(0) {
  std::uint32_t length = 0;
  while (name[length] != '\0') ++length;
  const struct {
    const char* name;
    Mode mode;
    std::uint32_t length;
  } request{name, mode, length};
  handle_ = ask_host(0x01, &request);
}

bool HostFile::read(void* to, std::uint32_t bytes) const {
  auto* next = static_cast<unsigned char*>(to);
  while (bytes > 0) {
    const struct {
      std::uint32_t handle;
      void* to;
      std::uint32_t bytes;
    } request{handle_, next, bytes};
    const std::uint32_t missing = ask_host(0x06, &request);
    if (missing >= bytes) return false;
    next += bytes - missing;
    bytes = missing;
  }
  return true;
}

bool HostFile::write(const void* from, std::uint32_t bytes) const {
  const struct {
    std::uint32_t handle;
    const void* from;
    std::uint32_t bytes;
  } request{handle_, from, bytes};
  return ask_host(0x05, &request) == 0;
}

void exit(std::uint32_t status) {
  const std::uint32_t block[2] = {0x20026U, status};
  ask_host(0x20, block);
  while (true) {
  }
}

void start_ticks() {
  *reinterpret_cast<volatile std::uint32_t*>(0xE000E014U) = 0xFFFFFFU;  // reload
  ticks_left = 0;
  *reinterpret_cast<volatile std::uint32_t*>(0xE000E010U) = 5U;  // on, processor clock, no interrupt
}

std::uint32_t float_flags() {
  std::uint32_t flags = 0;
#ifdef __ARM_FP
  __asm__ volatile("vmrs %0, fpscr" : "=r"(flags));
#endif
  return flags;
}

void watch_floats() {
#ifdef __ARM_FP
  __asm__ volatile("vmsr fpscr, %0" ::"r"(1U << 24U));
#endif
}

[[gnu::noinline]] void paint_stack() {
  std::uint32_t* here = static_cast<std::uint32_t*>(__builtin_frame_address(0)) - 8;
  for (std::uint32_t k = 0; k < painted_words; ++k) *--here = pattern;
  painted_from = here;
}

[[gnu::noinline]] std::uint32_t used_stack_bytes() {
  std::uint32_t unused = 0;
  while (unused < painted_words && painted_from[unused] == pattern) ++unused;
  return (painted_words - unused) * 4U;
}

}  // namespace board
