/// References of the machine on the core: strokes one at a time, what they come to, and the page moved on by it into
/// the spare one, in slices. Prints what each costs. Built beside a page valve.bin; no model is linked.
#include "spoolflow/sensor/machine_reference.hpp"

#include "board.hpp"
#include "spoolflow/sensor/parameter_image/moved_page.hpp"

namespace sensor = spoolflow::sensor;

__asm__(
    ".section .rodata.page\n.balign 32\npage_begin:\n.incbin \"valve.bin\"\npage_end:\n"
    ".text\n");
extern "C" const unsigned char page_begin[], page_end[];

namespace {

alignas(32) std::uint32_t spare_page[16384];
sensor::ReferenceState<float> state;
sensor::PageMove move;

std::uint32_t instructions_since(std::uint32_t before) {
  return board::instructions((before - board::ticks_left) & 0xFFFFFFU);
}

/// The costliest call of `work`, of which there are `count`.
template <class Work>
std::uint32_t costliest(std::uint32_t count, Work&& work) {
  std::uint32_t largest = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t before = board::ticks_left;
    work(k);
    const std::uint32_t cost = instructions_since(before);
    if (cost > largest) largest = cost;
  }
  return largest;
}

/// Strokes of 2.6 L in 3 to 12 s, of which the sensor sees 92 %, one with another consumer, one that is none.
sensor::MachineReference<float> stroke(std::uint32_t k) {
  const float seconds = 3.0F + 0.5F * static_cast<float>(7U * k % 19U), off = k % 2U == 0U ? 0.015F : -0.015F;
  const float share = k == 11U ? 1.3F : k == 17U ? 0.1F : 0.92F * (1.0F + off);
  return {2.6e-3F, 2e-6F, {2.6e-3F * share, seconds}};
}

[[gnu::noinline]] void take(const sensor::MachineKnowledge<float>& machine, std::uint32_t k) {
  static_cast<void>(update(machine, state, stroke(k)));
}
[[gnu::noinline]] sensor::MachineFinding<float> find(const sensor::MachineKnowledge<float>& machine) {
  return finding_of(machine, state);
}

void move_page(const sensor::ValveParameters& valve, const sensor::MachineFinding<float>& finding) {
  board::print("begin_refusal", static_cast<std::uint32_t>(begin(move, valve, finding, valve.header->created_s + 1U)));
  bool finished = false;
  const std::uint32_t slice = costliest(4096, [&](std::uint32_t) {
    finished = advance(move, 8, [](std::uint32_t place, std::uint32_t word) { spare_page[place] = word; });
  });
  board::print("slice", slice);
  board::print("finished", finished ? 1U : 0U);
  sensor::ValveParameters moved;
  board::print("spare_refusal", static_cast<std::uint32_t>(parameters_from(spare_page, sizeof spare_page, moved)));
  board::print("width_ppm",
               moved.header == nullptr ? 0U : static_cast<std::uint32_t>(1e6F * moved.header->adapted_edge_width));
}

}  // namespace

int main() {
  board::start_ticks();
  sensor::ValveParameters valve;
  board::print("refusal", static_cast<std::uint32_t>(
                              parameters_from(page_begin, static_cast<std::size_t>(page_end - page_begin), valve)));
  if (valve.observer_b == nullptr) return 1;
  sensor::MachineKnowledge<float> machine;
  machine.rated_flow_m3_per_s = valve.header->rated_flow_m3_per_s;
  machine.closed_m = valve.observer_b->edge.position_m.first;
  board::paint_stack();
  board::print("update", costliest(24, [&](std::uint32_t k) { take(machine, k); }));
  sensor::MachineFinding<float> finding{};
  board::print("finding", costliest(1, [&](std::uint32_t) { finding = find(machine); }));
  board::print("stack_bytes", board::used_stack_bytes());
  board::print("taken", static_cast<std::uint32_t>(state.taken));
  board::print("apart", static_cast<std::uint32_t>(state.apart));
  board::print("verdict", static_cast<std::uint32_t>(finding.verdict));
  board::print("state_bytes", sizeof state + sizeof machine + sizeof(sensor::PassedVolume<float>));
  board::print("move_bytes", sizeof move);
  move_page(valve, finding);
  return 0;
}
