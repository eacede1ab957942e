/* A recording through the sensor by firmware in C: the exported model, or with VALVE_SENSOR_NO_MODEL the flash page
 * valve.bin, changed while running to another page that holds the same valve. Prints what image_replay.cpp prints. */
#include "c_board.h"
#include "valve_sensor.h"

/* As packed_run.hpp has it: samples in the order of the sensor's own structure, then what the host answered. */
#if VALVE_SENSOR_WHOLE_VALVE
enum { numbers_a_point = 12 };
#else
enum { numbers_a_point = 6 };
#endif

__asm__(
    ".section .rodata.run\n.balign 8\nrun_begin:\n.incbin \"run.bin\", 0, 8\n"
    "run_points:\n.incbin \"run.bin\", 8\n.balign 4\n.text\n");
extern const uint32_t run_begin[];
extern const float run_points[];

static valve_sensor_state state;

static valve_sensor_sample sample_at(uint32_t k) {
  const float* const in = run_points + (uint32_t)numbers_a_point * k;
  valve_sensor_sample out = {.time_step_s = in[0]};
#if VALVE_SENSOR_WHOLE_VALVE
  out.current_a_A = in[1];
  out.current_b_A = in[2];
  out.voltage_a_V = in[3];
  out.voltage_b_V = in[4];
  out.position_m = in[5];
  out.oil_temperature_K = in[6];
#else
  out.current_A = in[1];
  out.voltage_V = in[2];
  out.position_m = in[3];
  out.oil_temperature_K = in[4];
#endif
  return out;
}

/* FNV-1a of all bytes of an answer. */
static uint32_t sum_with(uint32_t sum, const valve_sensor_answer* answer) {
  const unsigned char* const bytes = (const unsigned char*)answer;
  for (size_t k = 0; k < sizeof *answer; ++k) sum = (sum ^ bytes[k]) * 16777619U;
  return sum;
}

#ifdef VALVE_SENSOR_NO_MODEL

__asm__(
    ".section .rodata.page\n.balign 32\npage_begin:\n.incbin \"valve.bin\"\npage_end:\n"
    ".section .rodata.newer\n.balign 32\nnewer_begin:\n.incbin \"newer.bin\"\nnewer_end:\n"
    ".section .rodata.worn\n.balign 32\nworn_begin:\n.incbin \"worn.bin\"\n.text\n");
extern const unsigned char page_begin[], page_end[], newer_begin[], newer_end[], worn_begin[];

/* The page at work and, between samples, the look at the other one. */
static valve_sensor_page page;
static valve_sensor_check check;
static uint32_t looking = 0U;
static uint32_t switches = 0U;

static uint32_t begin_page(void) {
  const size_t size = (size_t)(page_end - page_begin);
  valve_sensor_page none;
  board_print("worn_refusal", valve_sensor_open_page(worn_begin, size, &none));
  looking = valve_sensor_check_begin(&check, newer_begin, (size_t)(newer_end - newer_begin)) == 0U ? 1U : 0U;
  return valve_sensor_open_page(page_begin, size, &page);
}

/* A slice of the look; once it is through and the other page is newer, the next sample is stepped with it. The state
 * stays: it is the same valve's. */
static void look_at_newer(void) {
  valve_sensor_page newer;
  if (looking == 0U || valve_sensor_check_advance(&check, 8U) == 0) return;
  looking = 0U;
  if (valve_sensor_check_found(&check, &newer) != 0U) return;
  if (valve_sensor_page_created_s(&newer) <= valve_sensor_page_created_s(&page)) return;
  page = newer;
  ++switches;
}

static void one_step(const valve_sensor_sample* sample) {
  look_at_newer();
  valve_sensor_step_with(&page, &state, sample);
}

#else

static uint32_t begin_page(void) {
  return valve_sensor_tables_intact() ? 0U : 1U;
}
static void one_step(const valve_sensor_sample* sample) {
  valve_sensor_step(&state, sample);
}

#endif

int main(void) {
  uint32_t sum = 2166136261U, largest = 0U;
  board_start_ticks();
  board_print("refusal", begin_page());
  valve_sensor_init(&state);
  for (uint32_t k = 0; k < run_begin[0]; ++k) {
    const valve_sensor_sample sample = sample_at(k);
    valve_sensor_answer answer;
    const uint32_t before = board_ticks();
    one_step(&sample);
    valve_sensor_answer_of(&state, &answer);
    const uint32_t count = board_instructions_since(before);
    if (count > largest) largest = count;
    sum = sum_with(sum, &answer);
    if (answer.status != valve_sensor_status(&state)) return 1;
  }
  board_print("points", run_begin[0]);
  board_print("answers_sum", sum);
  board_print("largest", largest);
  board_print("state_bytes", sizeof state);
#ifdef VALVE_SENSOR_NO_MODEL
  board_print("switches", switches);
#endif
  return 0;
}
