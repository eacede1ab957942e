/* Stand-in for a test: the types and calls of Zephyr's public sensor API that the driver and its users name. */
#ifndef TESTS_ZEPHYR_SENSOR_H
#define TESTS_ZEPHYR_SENSOR_H

#include <stdint.h>
#include <zephyr/device.h>

enum sensor_channel { SENSOR_CHAN_PRESS = 20, SENSOR_CHAN_ALL = 57, SENSOR_CHAN_COMMON_COUNT, SENSOR_CHAN_PRIV_START = SENSOR_CHAN_COMMON_COUNT, SENSOR_CHAN_MAX = INT16_MAX };

struct sensor_value {
  int32_t val1; /* integer part */
  int32_t val2; /* millionths, of the same sign */
};

struct sensor_driver_api {
  void *attr_set, *attr_get, *trigger_set;
  int (*sample_fetch)(const struct device *dev, enum sensor_channel chan);
  int (*channel_get)(const struct device *dev, enum sensor_channel chan, struct sensor_value *val);
};

static inline int sensor_sample_fetch_chan(const struct device *dev, enum sensor_channel chan) {
  return ((const struct sensor_driver_api *)dev->api)->sample_fetch(dev, chan);
}
static inline int sensor_sample_fetch(const struct device *dev) {
  return sensor_sample_fetch_chan(dev, SENSOR_CHAN_ALL);
}
static inline int sensor_channel_get(const struct device *dev, enum sensor_channel chan, struct sensor_value *val) {
  return ((const struct sensor_driver_api *)dev->api)->channel_get(dev, chan, val);
}

#ifdef TEST_ZEPHYR_4
#define DEVICE_API(class, name) const struct class##_driver_api name
#endif
#define POST_KERNEL 0
#define CONFIG_SENSOR_INIT_PRIORITY 90
#define SENSOR_DEVICE_DT_INST_DEFINE(inst, init_fn, pm_device, data_ptr, cfg_ptr, level, prio, api_ptr) \
  const struct device test_device_##inst = {"valve-flow", cfg_ptr, api_ptr, data_ptr, init_fn};         \
  _Static_assert((level) == POST_KERNEL && (prio) > 0, "of a sensor")

#endif
