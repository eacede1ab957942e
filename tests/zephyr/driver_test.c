/* driver_test OLDER.bin NEWER.bin: the Zephyr driver on a host answers as valve_sensor.h does, and works by the newer whole page.
 * Ends with 1 and the line of what does not hold. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <spoolflow/valve_flow.h>
#include <zephyr/devicetree.h>

#define HOLDS(what)                                                                     \
  do {                                                                                  \
    if (!(what)) return fprintf(stderr, "line %d does not hold: %s\n", __LINE__, #what), 1; \
  } while (0)

uint64_t test_flash[2][TEST_PAGE_BYTES / 8];
extern const struct device test_device_0, test_device_1;

static int load(const char *name, int page) {
  memset(test_flash[page], 0xFF, TEST_PAGE_BYTES);
  if (name == NULL) return 1; /* erased */
  FILE *in = fopen(name, "rb");
  if (in == NULL) return 0;
  const size_t got = fread(test_flash[page], 1, TEST_PAGE_BYTES, in);
  return fclose(in) == 0 && got > 1000 && got < TEST_PAGE_BYTES;
}

static valve_sensor_sample sample_at(int k) {
  const float opening = k < 2000 ? (float)k / 2000.0F : 1.0F;
  return (valve_sensor_sample){.time_step_s = k == 0 ? 0.0F : 1e-3F, .current_A = 1.5F * opening, .voltage_V = NAN,
                               .position_m = 1.6e-3F * opening, .oil_temperature_K = 323.15F};
}

static double channel(const struct device *dev, int which) {
  struct sensor_value value;
  if (sensor_channel_get(dev, (enum sensor_channel)which, &value) != 0) return NAN;
  return value.val1 + 1e-6 * value.val2;
}

static int near(double one, double other) {
  return fabs(one - other) <= 2e-6 + 1e-6 * fabs(other);
}

/* Both devices through a run: as the C interface alone, whichever numbers are at work, for they are the same valve's. */
static int answers_as_the_interface(void) {
  valve_sensor_state state;
  valve_sensor_answer answer;
  valve_sensor_init(&state);
  for (int k = 0; k < 3000; ++k) {
    const valve_sensor_sample sample = sample_at(k);
    valve_sensor_step(&state, &sample);
    spoolflow_step(&test_device_0, &sample);
    spoolflow_step(&test_device_1, &sample);
  }
  valve_sensor_answer_of(&state, &answer);
  HOLDS(answer.flow_m3_per_s > 1e-4F);
  for (int which = 0; which < 2; ++which) {
    const struct device *dev = which == 0 ? &test_device_0 : &test_device_1;
    const double before = channel(dev, SPOOLFLOW_CHAN_FLOW);
    HOLDS(before == 0); /* until something is fetched, the answer of before the first sample */
    HOLDS(sensor_sample_fetch(dev) == 0);
    HOLDS(near(channel(dev, SPOOLFLOW_CHAN_FLOW), answer.flow_m3_per_s * 60000.0));
    HOLDS(near(channel(dev, SPOOLFLOW_CHAN_FLOW_LOWER), answer.flow_lower_m3_per_s * 60000.0));
    HOLDS(near(channel(dev, SPOOLFLOW_CHAN_FLOW_UPPER), answer.flow_upper_m3_per_s * 60000.0));
    HOLDS(channel(dev, SPOOLFLOW_CHAN_FLOW_LOWER) < channel(dev, SPOOLFLOW_CHAN_FLOW));
    HOLDS(channel(dev, SPOOLFLOW_CHAN_FLOW) < channel(dev, SPOOLFLOW_CHAN_FLOW_UPPER));
    HOLDS(near(channel(dev, SPOOLFLOW_CHAN_PRESSURE_DIFFERENCE), answer.pressure_difference_Pa * 1e-3));
    struct sensor_value status;
    HOLDS(sensor_channel_get(dev, (enum sensor_channel)SPOOLFLOW_CHAN_STATUS, &status) == 0);
    HOLDS((uint32_t)status.val1 == answer.status && status.val2 == 0);
    HOLDS(sensor_channel_get(dev, SENSOR_CHAN_PRESS, &status) == -ENOTSUP);
    HOLDS(sensor_sample_fetch_chan(dev, SENSOR_CHAN_PRESS) == -ENOTSUP);
    HOLDS(sensor_sample_fetch_chan(dev, (enum sensor_channel)SPOOLFLOW_CHAN_STATUS) == 0);
  }
  return 0;
}

static int tells_of_faults(void) {
  valve_sensor_sample sample = sample_at(3000);
  struct sensor_value status;
  sample.position_m = NAN;
  spoolflow_step(&test_device_0, &sample);
  HOLDS(sensor_channel_get(&test_device_0, (enum sensor_channel)SPOOLFLOW_CHAN_STATUS, &status) == 0 && status.val2 == 0);
  HOLDS(sensor_sample_fetch(&test_device_0) == 0);
  HOLDS(sensor_channel_get(&test_device_0, (enum sensor_channel)SPOOLFLOW_CHAN_STATUS, &status) == 0);
  HOLDS(status.val2 == 1 && ((uint32_t)status.val1 & VALVE_SENSOR_FAULT_BITS) != 0U);
  return 0;
}

static int init_with(const char *page_a, const char *page_b) {
  return load(page_a, 0) && load(page_b, 1) && test_device_0.init(&test_device_0) == 0;
}

static int steps_until_the_check_ends(void) {
  const valve_sensor_sample sample = sample_at(0);
  for (int k = 0; k < 1000; ++k) spoolflow_step(&test_device_0, &sample);
  return spoolflow_page_at_work(&test_device_0);
}

static int works_by_the_newer_whole_page(const char *older, const char *newer) {
  HOLDS(init_with(NULL, NULL) && spoolflow_page_at_work(&test_device_0) == -ENOENT);
  HOLDS(init_with(older, newer) && spoolflow_page_at_work(&test_device_0) == 1);
  HOLDS(init_with(newer, older) && spoolflow_page_at_work(&test_device_0) == 0);
  HOLDS(init_with(older, NULL) && spoolflow_page_at_work(&test_device_0) == 0);
  HOLDS(load(newer, 1));
  test_flash[1][1000] ^= 4; /* a bit that has fallen */
  HOLDS(test_device_0.init(&test_device_0) == 0 && spoolflow_page_at_work(&test_device_0) == 0);
  HOLDS(spoolflow_page_written(&test_device_0, 0) == -EBUSY);
  HOLDS(spoolflow_page_written(&test_device_0, 2) == -EINVAL);
  HOLDS(spoolflow_page_written(&test_device_1, 0) == -EINVAL);
  HOLDS(spoolflow_page_written(&test_device_0, 1) == 0 && steps_until_the_check_ends() == 0); /* found damaged */
  HOLDS(load(NULL, 1) && spoolflow_page_written(&test_device_0, 1) == -EBADMSG);
  HOLDS(load(newer, 1) && spoolflow_page_written(&test_device_0, 1) == 0);
  HOLDS(spoolflow_page_at_work(&test_device_0) == 0); /* not before it is checked */
  HOLDS(steps_until_the_check_ends() == 1);
  HOLDS(load(older, 0) && spoolflow_page_written(&test_device_0, 0) == 0 && steps_until_the_check_ends() == 1);
  return 0;
}

int main(int argc, char **argv) {
  HOLDS(argc == 3);
  HOLDS(works_by_the_newer_whole_page(argv[1], argv[2]) == 0);
  for (int pages = 0; pages < 2; ++pages) { /* by the numbers compiled in, and by a page */
    HOLDS(init_with(NULL, pages ? argv[2] : NULL) && test_device_1.init(&test_device_1) == 0);
    HOLDS(answers_as_the_interface() == 0);
    HOLDS(tells_of_faults() == 0);
  }
  return 0;
}
