/* References of the machine taken by firmware in C, with what example_references.c of `export c` does of them. Prints what each
 * call costs. Built beside a page valve.bin, with VALVE_SENSOR_NO_MODEL. */
#define main example_main
#include "example_references.c"
#undef main

#include "c_board.h"

__asm__(
    ".section .rodata.page\n.balign 32\npage_begin:\n.incbin \"valve.bin\"\n.balign 4\npage_end:\n"
    ".text\n");
extern const uint32_t page_begin[], page_end[];

static uint32_t costliest_end = 0U;

static void costs(uint32_t before, uint32_t* most) {
  const uint32_t count = board_instructions_since(before);
  if (count > *most) *most = count;
}

static bool begin_with_the_page(void) {
  for (int k = 0; k < page_words; ++k) pages[0].words[k] = 0xFFFFFFFFU;
  for (uint32_t k = 0; page_begin + k < page_end; ++k) pages[0].words[k] = page_begin[k];
  valve_sensor_init(&state);
  return work_with(0);
}

static void open_the_valve(void) {
  for (int k = 0; k < 400; ++k) {
    const float opening = k < 300 ? (float)k / 300.0F : 1.0F;
    const valve_sensor_sample sample = {.time_step_s = 1e-3F, .current_A = 1.5F * opening, .voltage_V = 7.0F * opening,
                                        .position_m = 1.6e-3F * opening, .oil_temperature_K = 323.15F};
    one_sample(&sample, false);
  }
}

/* In 3 to 12 s, of which the sensor sees 92 %, one with another consumer, one of no oil. */
static uint32_t one_stroke(uint32_t k) {
  const float seconds = 3.0F + 0.5F * (float)(7U * k % 19U), off = k % 2U == 0U ? 0.015F : -0.015F;
  const float share = k == 11U ? 1.3F : k == 17U ? 0.1F : 0.92F * (1.0F + off);
  valve_sensor_answer answer;
  valve_sensor_answer_of(&state, &answer);
  valve_sensor_references_add(&references, &state, seconds);
  const uint32_t before = board_ticks();
  const uint32_t verdict = valve_sensor_references_end(&references, answer.flow_m3_per_s * seconds / share, ends_deviation_m3);
  costs(before, &costliest_end);
  return verdict;
}

int main(void) {
  uint32_t taken = 0U, apart = 0U, find = 0U, slice = 0U;
  board_start_ticks();
  board_print("refusal", begin_with_the_page() ? 0U : 1U);
  open_the_valve();
  for (uint32_t k = 0U; k < 24U; ++k) {
    const uint32_t verdict = one_stroke(k);
    taken += verdict == VALVE_SENSOR_REFERENCE_TAKEN ? 1U : 0U;
    apart += verdict == VALVE_SENSOR_REFERENCE_APART ? 1U : 0U;
  }
  strokes = (int)taken;
  const uint32_t before = board_ticks();
  board_print("verdict", look_for_wear(valve_sensor_page_created_s(&at_work) + 1U));
  costs(before, &find);
  for (int k = 0; moves && spare == 1; ++k) {
    const uint32_t ticks = board_ticks();
    write_a_slice();
    if (moves) costs(ticks, &slice);
  }
  board_print("taken", taken);
  board_print("apart", apart);
  board_print("end", costliest_end);
  board_print("find", find);
  board_print("slice", slice);
  board_print("bytes", sizeof references + sizeof moving);
  board_print("changed_over", spare == 0 ? 1U : 0U);
  return 0;
}
