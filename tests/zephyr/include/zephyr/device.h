/* Stand-in for a test: of Zephyr's device model what a sensor driver uses, by the public API. */
#ifndef TESTS_ZEPHYR_DEVICE_H
#define TESTS_ZEPHYR_DEVICE_H

struct device {
  const char *name;
  const void *config;
  const void *api;
  void *data;
  int (*init)(const struct device *dev); /* here called by the test */
};

#endif
