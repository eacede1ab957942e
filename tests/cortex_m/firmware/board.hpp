#pragma once
/// What the firmware needs of its board: text to the host, the end of the run, and a count of instructions.
#include <cstdint>

namespace board {

/// Text to the host (semihosting).
void print(const char* text);
/// "NAME number\n".
void print(const char* name, std::uint32_t number);
/// A file or pipe of the host (semihosting), by its name in the folder in which the emulator runs.
class HostFile {
 public:
  enum class Mode : std::uint32_t { read = 1, write = 5 };
  HostFile(const char* name, Mode mode);
  /// False where the file ends before.
  bool read(void* to, std::uint32_t bytes) const;
  bool write(const void* from, std::uint32_t bytes) const;

 private:
  std::uint32_t handle_;
};

/// Ends the run; 0: all was well.
[[noreturn]] void exit(std::uint32_t status);

/// SysTick, counting down; 24 bits.
inline volatile std::uint32_t& ticks_left = *reinterpret_cast<volatile std::uint32_t*>(0xE000E018U);
/// Starts SysTick on the processor's clock of 25 MHz. Under `-icount shift=6` an instruction takes 64 ns of it.
void start_ticks();
constexpr std::uint32_t instructions(std::uint32_t ticks) {
  return (ticks * 5U + 4U) / 8U;
}

/// The floating-point unit's status register: sticky flags of what happened since they were cleared. 0 without one.
std::uint32_t float_flags();
/// Clears the flags; results below the smallest normal number are flushed to zero and leave a flag.
void watch_floats();
inline constexpr std::uint32_t invalid_flag = 1U << 0U;               ///< an operation made a NaN, or compared one
inline constexpr std::uint32_t denormal_flags = 1U << 3U | 1U << 7U;  ///< a denormal result, a denormal operand

/// Fills the stack below the caller with a pattern, and returns how many bytes of it were used since.
void paint_stack();
std::uint32_t used_stack_bytes();

}  // namespace board
