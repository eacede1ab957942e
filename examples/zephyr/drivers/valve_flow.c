#define DT_DRV_COMPAT spoolflow_valve_flow

#include <spoolflow/valve_flow.h>

#include <errno.h>
#include <math.h>

#include <zephyr/devicetree.h>
#include <zephyr/kernel.h>

enum { pages = 2, compiled_in = -1 };

struct flow_config {
  const void *page[pages]; /* NULL: the devicetree names none */
  size_t bytes[pages];
};

struct flow_data {
  valve_sensor_state state;
  valve_sensor_page page; /* at work */
  int at_work;            /* its number, or compiled_in */
  valve_sensor_check check;
  int checked; /* number of the page that is being checked, or compiled_in */
  struct k_spinlock lock;
  valve_sensor_answer latest;  /* under the lock */
  valve_sensor_answer fetched; /* of the last sensor_sample_fetch */
};

static void take(struct flow_data *data, int number, const valve_sensor_page *page) {
  if (data->at_work != compiled_in && valve_sensor_page_created_s(page) <= valve_sensor_page_created_s(&data->page)) return;
  data->page = *page;
  data->at_work = number;
}

static void check_a_slice(struct flow_data *data) {
  valve_sensor_page found;
  if (data->checked == compiled_in || !valve_sensor_check_advance(&data->check, CONFIG_SPOOLFLOW_CHECKED_WORDS)) return;
  if (valve_sensor_check_found(&data->check, &found) == 0U) take(data, data->checked, &found);
  data->checked = compiled_in;
}

void spoolflow_step(const struct device *dev, const valve_sensor_sample *sample) {
  struct flow_data *data = dev->data;
  valve_sensor_answer answer;
  check_a_slice(data);
  if (data->at_work == compiled_in) {
    valve_sensor_step(&data->state, sample);
  } else {
    valve_sensor_step_with(&data->page, &data->state, sample);
  }
  valve_sensor_answer_of(&data->state, &answer);
  const k_spinlock_key_t key = k_spin_lock(&data->lock);
  data->latest = answer;
  k_spin_unlock(&data->lock, key);
}

int spoolflow_page_written(const struct device *dev, unsigned int page) {
  const struct flow_config *config = dev->config;
  struct flow_data *data = dev->data;
  if (page >= pages || config->page[page] == NULL) return -EINVAL;
  if (data->at_work == (int)page) return -EBUSY;
  if (valve_sensor_check_begin(&data->check, config->page[page], config->bytes[page]) != 0U) return -EBADMSG;
  data->checked = (int)page;
  return 0;
}

int spoolflow_page_at_work(const struct device *dev) {
  const struct flow_data *data = dev->data;
  return data->at_work == compiled_in ? -ENOENT : data->at_work;
}

static int flow_fetch(const struct device *dev, enum sensor_channel channel) {
  struct flow_data *data = dev->data;
  if (channel != SENSOR_CHAN_ALL && ((int)channel < SPOOLFLOW_CHAN_FLOW || (int)channel > SPOOLFLOW_CHAN_STATUS)) return -ENOTSUP;
  const k_spinlock_key_t key = k_spin_lock(&data->lock);
  data->fetched = data->latest;
  k_spin_unlock(&data->lock, key);
  return 0;
}

/* val1 + val2 * 1e-6, both of one sign. */
static void put(struct sensor_value *value, float number) {
  const float whole = truncf(number);
  value->val1 = (int32_t)whole;
  value->val2 = (int32_t)((number - whole) * 1e6F);
}

static int flow_get(const struct device *dev, enum sensor_channel channel, struct sensor_value *value) {
  const struct flow_data *data = dev->data;
  const float L_min_per_m3_s = 60000.0F, kPa_per_Pa = 1e-3F;
  switch ((int)channel) {
    case SPOOLFLOW_CHAN_FLOW:
      put(value, data->fetched.flow_m3_per_s * L_min_per_m3_s);
      return 0;
    case SPOOLFLOW_CHAN_FLOW_LOWER:
      put(value, data->fetched.flow_lower_m3_per_s * L_min_per_m3_s);
      return 0;
    case SPOOLFLOW_CHAN_FLOW_UPPER:
      put(value, data->fetched.flow_upper_m3_per_s * L_min_per_m3_s);
      return 0;
    case SPOOLFLOW_CHAN_PRESSURE_DIFFERENCE:
      put(value, data->fetched.pressure_difference_Pa * kPa_per_Pa);
      return 0;
    case SPOOLFLOW_CHAN_STATUS:
      value->val1 = (int32_t)data->fetched.status;
      value->val2 = (data->fetched.status & VALVE_SENSOR_FAULT_BITS) != 0U;
      return 0;
    default:
      return -ENOTSUP;
  }
}

/* The newer whole page, or what is compiled in. */
static int flow_init(const struct device *dev) {
  const struct flow_config *config = dev->config;
  struct flow_data *data = dev->data;
  data->at_work = data->checked = compiled_in;
  for (int number = 0; number < pages; ++number) {
    valve_sensor_page page;
    if (config->page[number] != NULL && valve_sensor_open_page(config->page[number], config->bytes[number], &page) == 0U)
      take(data, number, &page);
  }
  if (data->at_work == compiled_in && !valve_sensor_tables_intact()) return -EIO;
  valve_sensor_init(&data->state);
  valve_sensor_answer_of(&data->state, &data->latest);
  data->fetched = data->latest;
  return 0;
}

#ifdef DEVICE_API /* Zephyr 4 */
static DEVICE_API(sensor, flow_api) = {
#else
static const struct sensor_driver_api flow_api = {
#endif
    .sample_fetch = flow_fetch, .channel_get = flow_get};

#define PARTITION(inst, number) DT_INST_PHANDLE_BY_IDX(inst, parameter_pages, number)
#define PAGE(inst, number) (const void *)DT_FIXED_PARTITION_ADDR(PARTITION(inst, number))
#define WITH_PAGES(inst)                         \
  .page = {PAGE(inst, 0), PAGE(inst, 1)}, .bytes = { \
    DT_REG_SIZE(PARTITION(inst, 0)), DT_REG_SIZE(PARTITION(inst, 1)) }
#define FLOW_SENSOR(inst)                                                                                             \
  static struct flow_data flow_data_##inst;                                                                           \
  static const struct flow_config flow_config_##inst = {                                                              \
      COND_CODE_1(DT_INST_NODE_HAS_PROP(inst, parameter_pages), (WITH_PAGES(inst)), (.bytes = {0}))};                 \
  SENSOR_DEVICE_DT_INST_DEFINE(inst, flow_init, NULL, &flow_data_##inst, &flow_config_##inst, POST_KERNEL,            \
                               CONFIG_SENSOR_INIT_PRIORITY, &flow_api);

DT_INST_FOREACH_STATUS_OKAY(FLOW_SENSOR)
