/* Written from spoolflow.h alone: one sample through a model. */
#include <math.h>
#include <spoolflow.h>
#include <stdio.h>

int main(int argc, char** argv) {
  char message[256];
  spoolflow_sensor* sensor;
  const spoolflow_sample sample = {0.0, 1.2, NAN, 1.2e-3, NAN};
  spoolflow_estimate estimate;
  if (argc != 2) return 2;
  if (spoolflow_create(argv[1], SPOOLFLOW_BEST, &sensor, message, sizeof message) != SPOOLFLOW_OK) {
    fprintf(stderr, "%s\n", message);
    return 2;
  }
  if (spoolflow_step(sensor, &sample, &estimate) != SPOOLFLOW_OK) return 1;
  printf("%s %.3f L/min\n", spoolflow_version(), estimate.flow_m3_per_s * 60000);
  spoolflow_destroy(sensor);
  return 0;
}
