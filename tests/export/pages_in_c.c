/* pages_in_c OLDER.bin NEWER.bin: example_pages.c of `export c`, on a host, with pages that hold what is exported: the newer whole
 * one is at work, also one that comes in while the sensor runs, and the answers stay. Ends with 1 and the line of what does
 * not hold. */
#define main example_main
#include "example_pages.c"
#undef main

#include <stdio.h>
#include <string.h>

#define HOLDS(what)                                                                     \
  do {                                                                                  \
    if (!(what)) return fprintf(stderr, "line %d does not hold: %s\n", __LINE__, #what), 1; \
  } while (0)

static int load(const char *name, unsigned char *page) {
  memset(page, 0xFF, page_bytes);
  if (name == NULL) return 1; /* erased */
  FILE *in = fopen(name, "rb");
  if (in == NULL) return 0;
  const size_t got = fread(page, 1, page_bytes, in);
  return fclose(in) == 0 && got > 1000 && got < page_bytes;
}

/* At start-up: 'a', 'b' or, for the numbers that are compiled in, 'c'. */
static char chosen(const char *a, const char *b) {
  if (!load(a, page_a.bytes) || !load(b, page_b.bytes)) return '?';
  at_work.header = NULL;
  choose_page();
  return at_work.header == (const void *)page_a.bytes ? 'a' : at_work.header == (const void *)page_b.bytes ? 'b' : 'c';
}

static valve_sensor_sample sample_at(int k) {
  const float opening = k < 2000 ? (float)k / 2000.0F : 1.0F;
  return (valve_sensor_sample){.time_step_s = k == 0 ? 0.0F : 1e-3F, .current_A = 1.5F * opening, .voltage_V = 7.0F * opening,
                               .position_m = 1.6e-3F * opening, .oil_temperature_K = 323.15F};
}

/* While the sensor runs on page A, B comes in; each answer is that of the numbers compiled in, which are the same valve's. */
static int takes_a_page_while_it_runs(const char *older, const char *newer) {
  static valve_sensor_state by_model;
  int steps_to_take_over = 0;
  HOLDS(chosen(older, NULL) == 'a');
  valve_sensor_init(&state);
  valve_sensor_init(&by_model);
  for (int k = 0; k < 3000; ++k) {
    const valve_sensor_sample sample = sample_at(k);
    if (k == 1000) {
      HOLDS(load(newer, page_b.bytes));
      page_came_in(page_b.bytes);
      HOLDS(checking);
    }
    one_sample(&sample);
    if (k >= 1000 && at_work.header == (const void *)page_a.bytes) ++steps_to_take_over;
    valve_sensor_step(&by_model, &sample);
    valve_sensor_answer answer, expected;
    valve_sensor_answer_of(&state, &answer);
    valve_sensor_answer_of(&by_model, &expected);
    HOLDS(memcmp(&answer, &expected, sizeof answer) == 0);
  }
  HOLDS(at_work.header == (const void *)page_b.bytes);
  HOLDS(steps_to_take_over > 50); /* in slices */
  HOLDS(load(older, page_a.bytes));
  page_came_in(page_a.bytes);
  for (int k = 3000; k < 6000; ++k) one_sample(&(valve_sensor_sample){.time_step_s = 1e-3F, .oil_temperature_K = 323.15F});
  HOLDS(!checking && at_work.header == (const void *)page_b.bytes); /* it is older */
  return 0;
}

int main(int argc, char **argv) {
  HOLDS(argc == 3);
  const char *older = argv[1], *newer = argv[2];
  HOLDS(chosen(NULL, NULL) == 'c');
  HOLDS(chosen(older, newer) == 'b');
  HOLDS(chosen(newer, older) == 'a');
  HOLDS(chosen(NULL, older) == 'b');
  HOLDS(chosen(newer, older) == 'a');
  page_a.bytes[5000] ^= 1; /* a bit of the newer page has fallen */
  at_work.header = NULL;
  choose_page();
  HOLDS(at_work.header == (const void *)page_b.bytes);
  HOLDS(takes_a_page_while_it_runs(older, newer) == 0);
  return example_main() == 0 ? 0 : 1;
}
