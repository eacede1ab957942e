/// The firmware of a valve's electronics on an emulated Cortex-M4F: each millisecond a sample comes in and orders to
/// the amplifiers go out, over two pipes of the host instead of converters and timers. At the end it reports what it
/// cost.
#include "board.hpp"
#include "parameter_pages.hpp"
#include "valve_control.hpp"
#include "wire.hpp"

// Two pages of flash, of which the second is erased, and the image that comes in later; the emulated flash cannot be
// written, so the pages lie in memory.
__asm__(
    ".section .data.pages\n.balign 32\nfirst_page:\n.incbin \"valve.bin\"\nfirst_page_end:\n"
    ".balign 32\nsecond_page:\n.fill 65536, 1, 0xFF\n"
    ".section .rodata.newer\n.balign 32\nnewer:\n.incbin \"newer.bin\"\nnewer_end:\n.text\n");
extern "C" unsigned char first_page[], first_page_end[], second_page[];
extern "C" const unsigned char newer[], newer_end[];

namespace {

constexpr std::uint32_t magic_bytes = 8;
constexpr std::uint32_t bytes_a_sample = 512;

/// Writes the newer image to the second page in pieces, its first bytes last: until then it is none.
class FlashWriter {
 public:
  void begin() { next_ = magic_bytes; }
  void write_piece() {
    const auto size = static_cast<std::uint32_t>(newer_end - newer);
    if (next_ == 0) return;
    for (std::uint32_t k = 0; k < bytes_a_sample && next_ < size; ++k, ++next_) second_page[next_] = newer[next_];
    if (next_ < size) return;
    for (next_ = magic_bytes; next_ > 0; --next_) second_page[next_ - 1] = newer[next_ - 1];
  }

 private:
  std::uint32_t next_ = 0;  ///< 0: nothing to write
};

std::uint32_t instructions_since(std::uint32_t before) {
  return board::instructions((before - board::ticks_left) & 0xFFFFFFU);
}

void keep_largest(std::uint32_t& largest, std::uint32_t count) {
  if (count > largest) largest = count;
}

ControlState state;
constexpr ControlSettings settings;

[[gnu::noinline, gnu::flatten]] Orders one_sample(const sensor::WholeValveParameters<float>* valve,
                                                  const Measured& in) {
  const sensor::WholeValveSample<float> sample{1e-3F,          in.current_a_A, in.current_b_A,      in.voltage_a_V,
                                               in.voltage_b_V, in.position_m,  in.oil_temperature_K};
  return control(settings, state, valve, sample, in.set_position_m);
}

void happen(Event event, const ParameterPages& pages, FlashWriter& flash) {
  if (event == Event::newer_page) flash.begin();
  if (event == Event::bit_falls) (pages.at_work() == 2 ? second_page : first_page)[20000] ^= 4U;
}

}  // namespace

int main() {
  board::start_ticks();
  ParameterPages pages(first_page, second_page, 65536);
  pages.start();
  if (pages.at_work() == 0) return 1;  // no sensor from the start: reported before the machine runs
  const board::HostFile samples("samples", board::HostFile::Mode::read);
  const board::HostFile answers("answers", board::HostFile::Mode::write);
  FlashWriter flash;
  Measured in;
  std::uint32_t steps = 0, largest = 0, slice = 0;
  for (; samples.read(&in, sizeof in); ++steps) {
    std::uint32_t before = board::ticks_left;
    const Orders orders = one_sample(pages.valve(), in);
    keep_largest(largest, instructions_since(before));
    sensor::Estimate<float> answer = state.sensor.open.last;
    if (pages.valve() == nullptr) answer.flow_m3_per_s = __builtin_nanf("");
    const Ordered out{sensor::larger(-orders.set_A, 0.0F),
                      sensor::larger(orders.set_A, 0.0F),
                      orders.dither.amplitude_A,
                      orders.dither.frequency_Hz,
                      answer.flow_m3_per_s,
                      answer.flow_lower_m3_per_s,
                      answer.flow_upper_m3_per_s,
                      static_cast<std::uint32_t>(answer.status),
                      static_cast<std::uint32_t>(orders.trust),
                      pages.at_work()};
    if (!answers.write(&out, sizeof out)) return 2;
    happen(in.event, pages, flash);
    flash.write_piece();
    before = board::ticks_left;
    pages.look();
    keep_largest(slice, instructions_since(before));
  }
  board::print("samples", steps);
  board::print("largest control step", largest);
  board::print("largest look at a page", slice);
  return 0;
}
