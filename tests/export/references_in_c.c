/* references_in_c PAGE.bin MOVED.bin: example_references.c of `export c`, on a host: a cylinder that takes 5 % more oil than the sensor
 * says moves the page at work on into the spare one while the sensor runs, and the sensor then says more. A machine that agrees
 * moves nothing. Writes the moved page. Ends with 1 and the line of what does not hold. */
#define main example_main
#include "example_references.c"
#undef main

#include <stdio.h>
#include <string.h>

#define HOLDS(what)                                                                     \
  do {                                                                                  \
    if (!(what)) return fprintf(stderr, "line %d does not hold: %s\n", __LINE__, #what), 1; \
  } while (0)

static valve_sensor_sample open_by(float opening) {
  return (valve_sensor_sample){.time_step_s = 1e-3F, .current_A = 1.5F * opening, .voltage_V = 7.0F * opening,
                               .position_m = 1.6e-3F * opening, .oil_temperature_K = 323.15F};
}

static float flow_m3_per_s(void) {
  valve_sensor_answer answer;
  valve_sensor_answer_of(&state, &answer);
  return answer.flow_m3_per_s;
}

/* One stroke of a cylinder that takes so many times the oil that the sensor sees. */
static void stroke_of(float times, float opening) {
  const valve_sensor_sample sample = open_by(opening);
  double filled_m3 = 0;
  for (int k = 0; k < 300; ++k) { one_sample(&sample, false); }
  while (filled_m3 < (double)stroke_m3) {
    one_sample(&sample, true);
    filled_m3 += 1e-3 * (double)times * (double)flow_m3_per_s();
  }
  one_sample(&sample, false);
}

static int load(const char* name) {
  FILE* const in = fopen(name, "rb");
  memset(pages, 0xFF, sizeof pages);
  if (in == NULL) return 0;
  const size_t got = fread(pages[0].words, 1, sizeof pages[0].words, in);
  valve_sensor_init(&state);
  return fclose(in) == 0 && got > 1000 && work_with(0);
}

static int strokes_of(float times) {
  const valve_sensor_sample closed = open_by(0);
  for (int k = 0; k < 22; ++k) { stroke_of(times, 0.7F + 0.015F * (float)(7 * k % 20)); }
  for (int k = 0; k < 300; ++k) {
    one_sample(&closed, false);
    if (k > 100) { stands_closed(&closed); }
  }
  return strokes;
}

int main(int argc, char** argv) {
  HOLDS(argc == 3);
  HOLDS(load(argv[1]));
  HOLDS(strokes_of(1.0F) == 22);
  HOLDS(look_for_wear(1800000000U) == VALVE_SENSOR_REFERENCES_STAY);
  HOLDS(!moves);

  HOLDS(load(argv[1]));
  HOLDS(look_for_wear(1800000000U) == VALVE_SENSOR_REFERENCES_TOO_FEW);
  in_stroke = true; /* at start-up the piston is under way: that stroke is not whole */
  stroke_is_whole = false;
  const valve_sensor_sample sample = open_by(1);
  one_sample(&sample, true);
  one_sample(&sample, false);
  HOLDS(strokes == 0);
  HOLDS(strokes_of(1.05F) == 22);
  stroke_of(1.05F, 1);
  const float before = flow_m3_per_s();
  HOLDS(look_for_wear(1000000000U) == VALVE_SENSOR_REFERENCES_MOVE);
  HOLDS(!moves); /* older than the page at work */
  HOLDS(look_for_wear(1800000000U) == VALVE_SENSOR_REFERENCES_MOVE);
  HOLDS(moves);
  int samples = 0;
  for (; moves; ++samples) {
    one_sample(&sample, false);
    write_a_slice();
  }
  HOLDS(samples > 1000);
  HOLDS(spare == 0 && at_work.header == (const void*)pages[1].words);
  HOLDS(valve_sensor_page_created_s(&at_work) == 1800000000U);
  HOLDS(look_for_wear(1900000000U) == VALVE_SENSOR_REFERENCES_TOO_FEW);
  for (int k = 0; k < 3000; ++k) { one_sample(&sample, false); }
  HOLDS(flow_m3_per_s() > 1.03F * before && flow_m3_per_s() < 1.12F * before); /* the edge passes more */
  FILE* const out = fopen(argv[2], "wb");
  HOLDS(out != NULL && fwrite(pages[1].words, 1, sizeof pages[1].words, out) == sizeof pages[1].words && fclose(out) == 0);
  return example_main();
}
