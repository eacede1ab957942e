/* The flow-rate sensor of a spool valve as a Zephyr sensor.
 *
 * The valve's control loop calls spoolflow_step once a period; any thread reads by sensor_sample_fetch and
 * sensor_channel_get. The channels of one fetch belong to one sample. */
#ifndef SPOOLFLOW_VALVE_FLOW_H
#define SPOOLFLOW_VALVE_FLOW_H

#include <zephyr/device.h>
#include <zephyr/drivers/sensor.h>

#include "valve_sensor.h"

#ifdef __cplusplus
extern "C" {
#endif

enum spoolflow_channel {
  SPOOLFLOW_CHAN_FLOW = SENSOR_CHAN_PRIV_START, /* L/min, > 0 from P to B */
  SPOOLFLOW_CHAN_FLOW_LOWER,                    /* L/min, lower end of the 95 % band */
  SPOOLFLOW_CHAN_FLOW_UPPER,                    /* L/min, upper end */
  SPOOLFLOW_CHAN_PRESSURE_DIFFERENCE,           /* kPa, as SENSOR_CHAN_PRESS */
  SPOOLFLOW_CHAN_STATUS                         /* val1: bits of valve_sensor.h; val2: 1 where one of them is a fault */
};

/* Steps the sensor. Called from one thread, with the floating-point unit (CONFIG_FPU; CONFIG_FPU_SHARING where other
 * threads use it). */
void spoolflow_step(const struct device *dev, const valve_sensor_sample *sample);

/* A page has been written, 0 (A) or 1 (B), not the one at work. It is checked in slices by the following steps and is
 * at work when it is whole and newer. Called from the thread of spoolflow_step. Returns 0; -EINVAL where the devicetree
 * names no such page; -EBUSY for the page at work; -EBADMSG where it does not begin as an image does. */
int spoolflow_page_written(const struct device *dev, unsigned int page);

/* The page at work: 0, 1, or -ENOENT for the numbers that are compiled in. */
int spoolflow_page_at_work(const struct device *dev);

#ifdef __cplusplus
}
#endif

#endif
