/* estimate MODEL.json < recording.csv: the flow rate of every row, by the C interface.
 *
 * The recording has columns time_s, current_A, position_mm and, better also, voltage_V and oil_temperature_C, in any order
 * and among others, separated by commas; an empty or unreadable value counts as missing.
 * Build: cc estimate.c $(pkg-config --cflags --libs spoolflow) -lm */
#include <math.h>
#include <spoolflow.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { time_column, current_column, voltage_column, position_column, temperature_column, columns };
static const char* const headers[columns] = {"time_s", "current_A", "voltage_V", "position_mm", "oil_temperature_C"};

/* Ends the text at the next comma or line end and returns what follows, or NULL after the last value. */
static char* cut(char* text) {
  char* const end = text + strcspn(text, ",\r\n");
  const int more = *end == ',';
  *end = '\0';
  return more ? end + 1 : NULL;
}

static double number(const char* text) {
  char* end;
  const double value = strtod(text, &end);
  return end == text ? NAN : value;
}

int main(int argc, char** argv) {
  char line[4096], message[512], status[256];
  int place[columns] = {-1, -1, -1, -1, -1};
  spoolflow_sensor* sensor;

  if (argc != 2) {
    fprintf(stderr, "usage: %s MODEL.json < recording.csv\n", argv[0]);
    return 2;
  }
  if (spoolflow_create(argv[1], SPOOLFLOW_BEST, &sensor, message, sizeof message) != SPOOLFLOW_OK) {
    fprintf(stderr, "%s\n", message);
    return 2;
  }
  fprintf(stderr, "%s, full scale %g L/min, %s\n", spoolflow_valve_name(sensor), spoolflow_rated_flow(sensor) * 60000,
          spoolflow_runs(sensor) == SPOOLFLOW_OBSERVER ? "observer" : "condensed sensor");

  if (fgets(line, sizeof line, stdin) != NULL) {
    int k = 0;
    for (char *text = line, *next; text != NULL; text = next, ++k) {
      next = cut(text);
      for (int c = 0; c < columns; ++c) {
        if (strcmp(text, headers[c]) == 0) place[c] = k;
      }
    }
  }
  if (place[time_column] < 0 || place[current_column] < 0 || place[position_column] < 0) {
    fprintf(stderr, "the first line must name the columns time_s, current_A and position_mm\n");
    spoolflow_destroy(sensor);
    return 2;
  }

  puts("time_s,flow_L_min,flow_lower_L_min,flow_upper_L_min,status");
  while (fgets(line, sizeof line, stdin) != NULL) {
    double value[columns] = {NAN, NAN, NAN, NAN, NAN};
    int k = 0;
    for (char *text = line, *next; text != NULL; text = next, ++k) {
      next = cut(text);
      for (int c = 0; c < columns; ++c) {
        if (place[c] == k) value[c] = number(text);
      }
    }
    const spoolflow_sample sample = {.time_s = value[time_column],
                                     .current_A = value[current_column],
                                     .voltage_V = value[voltage_column],
                                     .position_m = value[position_column] / 1000,
                                     .oil_temperature_K = value[temperature_column] + 273.15};
    spoolflow_estimate estimate;
    spoolflow_step(sensor, &sample, &estimate);
    spoolflow_status_text(estimate.status, status, sizeof status);
    printf("%.6f,%.6f,%.6f,%.6f,%s\n", sample.time_s, estimate.flow_m3_per_s * 60000,
           estimate.flow_lower_m3_per_s * 60000, estimate.flow_upper_m3_per_s * 60000, status);
  }
  spoolflow_destroy(sensor);
  return 0;
}
