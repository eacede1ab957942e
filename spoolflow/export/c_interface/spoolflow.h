/* spoolflow.h: the flow rate of a solenoid-operated spool valve from its own signals. C interface, C99 and later.
 *
 *     spoolflow_sensor* sensor;
 *     char message[256];
 *     if (spoolflow_create("valve.json", SPOOLFLOW_BEST, &sensor, message, sizeof message) != SPOOLFLOW_OK) {
 *       fprintf(stderr, "%s\n", message);
 *       return 1;
 *     }
 *     spoolflow_sample sample = {.time_s = 0.0, .current_A = 1.2, .voltage_V = 9.5, .position_m = 1.1e-3,
 *                                .oil_temperature_K = 323.15};
 *     spoolflow_estimate estimate;
 *     spoolflow_step(sensor, &sample, &estimate);      once a sample, usually every millisecond
 *     printf("%g L/min\n", estimate.flow_m3_per_s * 60000);
 *     spoolflow_destroy(sensor);
 *
 * Build:    cc program.c $(pkg-config --cflags --libs spoolflow); for Windows x86_64-w64-mingw32-gcc program.c libspoolflow.dll.a,
 *           or cl program.c spoolflow.lib, of which lib /def:spoolflow.def /machine:x64 is made
 * Model:    a file that `spoolflow calibrate` wrote; one file describes one valve.
 * Units:    SI everywhere, named in each member: m3/s, Pa, N, A, V, m, K, s. Pressures are differences.
 * Signs:    position 0 closed, > 0 opens the edge P to B; magnetic force opens (+), spring and flow force close (+),
 *           friction has the sign of the velocity. Of a whole 4/3 valve (spoolflow_is_whole) the position counts from the
 *           centre and is < 0 where the spool opens P to A; flow and forces then are < 0, too. Its solenoid a opens P to
 *           A, solenoid b P to B; spoolflow_step_whole takes the signals of both.
 * Missing:  an input that was not measured is NaN (<math.h>: NAN). Infinite values and values beyond 1e9 count as
 *           missing, too.
 * Threads:  the library has no global state. Any number of sensors may work at once; one sensor is used by one thread
 *           at a time.
 * Errors:   every function that can fail returns a spoolflow_result. Functions with `message` write one sentence there
 *           that names file, place, value and remedy: at most message_size bytes, always ended by 0; an empty text where
 *           all is well. `message` may be NULL. Nothing is printed, and nothing ends the program.
 */
#ifndef SPOOLFLOW_H
#define SPOOLFLOW_H

#include <stddef.h>
#include <stdint.h>

/* Version of this header; spoolflow_version() is that of the library which is loaded. */
#define SPOOLFLOW_VERSION_MAJOR 1
#define SPOOLFLOW_VERSION_MINOR 0
#define SPOOLFLOW_VERSION_PATCH 0
#define SPOOLFLOW_VERSION "1.0.0"

#if defined(_WIN32)
#if defined(SPOOLFLOW_BUILDS_DLL)
#define SPOOLFLOW_API __declspec(dllexport)
#else
#define SPOOLFLOW_API /* functions alone: a program may call them through the import library as they are */
#endif
#elif defined(__GNUC__)
#define SPOOLFLOW_API __attribute__((visibility("default")))
#else
#define SPOOLFLOW_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* NOLINTBEGIN(modernize-use-using): this is C. */

/* What a call came to. */
typedef enum spoolflow_result {
  SPOOLFLOW_OK = 0,
  SPOOLFLOW_BAD_ARGUMENT = 1,   /* a pointer is NULL that must not be, or an enumerator is unknown */
  SPOOLFLOW_BAD_FILE = 2,       /* the model file cannot be opened or is empty */
  SPOOLFLOW_BAD_MODEL = 3,      /* the text is no model, is damaged, or is of another version */
  SPOOLFLOW_NOT_CALIBRATED = 4, /* the observer was asked for, and the model has none */
  SPOOLFLOW_BAD_STATE = 5,      /* the bytes are no state, are damaged, or belong to another model, estimator, version */
  SPOOLFLOW_TOO_SMALL = 6,      /* the caller's buffer is too small; the function's partner returns the needed size */
  SPOOLFLOW_OUT_OF_MEMORY = 7,
  SPOOLFLOW_FAILED = 8          /* anything else; see the message */
} spoolflow_result;

/* Which sensor runs. The condensed sensor averages: two maps and the springs. The observer adds magnetic hysteresis, eddy
 * currents, friction, oil temperature and position faults, and needs a model that was calibrated for it. */
typedef enum spoolflow_estimator {
  SPOOLFLOW_BEST = 0, /* the observer where the model has one, the condensed sensor otherwise */
  SPOOLFLOW_CONDENSED = 1,
  SPOOLFLOW_OBSERVER = 2
} spoolflow_estimator;

/* Bits of spoolflow_estimate.status; 0 when all is well. Limits: the answer is bounded by calibration or physics. */
#define SPOOLFLOW_STATUS_CLOSED (UINT32_C(1) << 0)                 /* the spool covers the edge: leakage only */
#define SPOOLFLOW_STATUS_SPOOL_AT_REST (UINT32_C(1) << 1)          /* friction is unknown: the band is wide */
#define SPOOLFLOW_STATUS_OUTSIDE_FORCE_MAP (UINT32_C(1) << 2)      /* current or position beyond the force map */
#define SPOOLFLOW_STATUS_OUTSIDE_FLOW_FORCE_MAP (UINT32_C(1) << 3) /* flow force beyond what was measured */
#define SPOOLFLOW_STATUS_OUTSIDE_TEMPERATURE (UINT32_C(1) << 4)    /* oil colder or warmer than calibrated */
#define SPOOLFLOW_STATUS_CURRENT_SATURATED (UINT32_C(1) << 5)      /* the current is at the end of its range */
#define SPOOLFLOW_STATUS_DITHERED (UINT32_C(1) << 6)               /* the current is dithered: friction swings */
#define SPOOLFLOW_STATUS_SIGN_UNDETERMINED (UINT32_C(1) << 7)      /* so near the centre that the flow may go either way */
#define SPOOLFLOW_STATUS_AMBIGUOUS_LOAD (UINT32_C(1) << 8)         /* a load may drive the oil: the flow may be larger */
#define SPOOLFLOW_STATUS_FLOW_REVERSED (UINT32_C(1) << 9)          /* by the port pressures a load drives the oil back */
#define SPOOLFLOW_STATUS_OPEN_STOP (UINT32_C(1) << 10)             /* the spool stands on its open stop: the flow may be smaller */
/* Faults: an input or the model cannot be trusted. */
#define SPOOLFLOW_STATUS_POSITION_FAULT (UINT32_C(1) << 16) /* the position moved as no spool can: the last credible one is used; or stays closed against forces that move any spool: the band is open */
#define SPOOLFLOW_STATUS_SAMPLE_MISSING (UINT32_C(1) << 17) /* current or position missing: the last flow is held, its band opens */
#define SPOOLFLOW_STATUS_OTHER_DIRECTION (UINT32_C(1) << 18) /* the spool opens the direction that the model does not know */
#define SPOOLFLOW_STATUS_TIME_FAULT (UINT32_C(1) << 19)     /* time stood still, ran backwards, or is NaN; see spoolflow_step */
#define SPOOLFLOW_STATUS_COIL_FAULT (UINT32_C(1) << 20)     /* voltage and current give a resistance that no sound coil has, or either is far beyond the calibration's */
#define SPOOLFLOW_STATUS_TEMPERATURE_FAULT (UINT32_C(1) << 21) /* the oil temperature reads what no oil has: the one before is held */
#define SPOOLFLOW_STATUS_CURRENT_FAULT (UINT32_C(1) << 23) /* the current leapt as no coil lets it: the last credible one is used */
/* Any of the faults. */
#define SPOOLFLOW_STATUS_FAULTS UINT32_C(0xFFFF0000)

/* One sample of what the valve's electronics have. */
typedef struct spoolflow_sample {
  double time_s;            /* of the sample, from any origin; rises from sample to sample by 50 us to 5 ms */
  double current_A;         /* coil current, mean since the sample before; 0 to the current range of the model */
  double voltage_V;         /* coil voltage, mean since the sample before; NaN: not measured */
  double position_m;        /* spool position; 0 closed, > 0 open, up to the stroke (some millimetres) */
  double oil_temperature_K; /* 0 degC is 273.15; NaN: not measured, the last one is held, at first the calibration's middle */
} spoolflow_sample;

/* The flow rate with its 95 % band, and what led to it. Never NaN. */
typedef struct spoolflow_estimate {
  double flow_m3_per_s;
  double flow_lower_m3_per_s; /* 95 % band; may lie below 0 */
  double flow_upper_m3_per_s;
  double pressure_difference_Pa; /* over the metering edge */
  double magnetic_force_N;
  double spring_force_N;
  double flow_force_N;
  double friction_force_N; /* 0 from the condensed sensor, which averages friction out */
  uint32_t status;         /* SPOOLFLOW_STATUS_ bits */
} spoolflow_estimate;

/* A sensor in operation. Made by spoolflow_create and its like, ended by spoolflow_destroy. */
typedef struct spoolflow_sensor spoolflow_sensor;

/* The library's version, such as "1.0.0"; lives as long as the program. */
SPOOLFLOW_API const char* spoolflow_version(void);

/* Makes a sensor from a model file.
 * path:      of the file, in the encoding of the system's file functions.
 * estimator: which sensor to run. With SPOOLFLOW_BEST a model without observer gives the condensed sensor and no error;
 *            spoolflow_runs returns which one it became.
 * sensor:    gets the sensor, or NULL where the call fails.
 * Returns SPOOLFLOW_OK, BAD_ARGUMENT, BAD_FILE, BAD_MODEL, NOT_CALIBRATED, OUT_OF_MEMORY, FAILED. */
SPOOLFLOW_API spoolflow_result spoolflow_create(const char* path, spoolflow_estimator estimator,
                                                spoolflow_sensor** sensor, char* message, size_t message_size);

/* The same from the file's text in memory: `size` bytes, which need not end with 0 and may go after the call. Messages call
 * the text "model". Returns as spoolflow_create, without BAD_FILE. */
SPOOLFLOW_API spoolflow_result spoolflow_create_from_memory(const char* text, size_t size, spoolflow_estimator estimator,
                                                            spoolflow_sensor** sensor, char* message,
                                                            size_t message_size);

/* Makes a second sensor of the same valve in the same state; both go their own ways. The model is shared, not copied.
 * Returns SPOOLFLOW_OK, BAD_ARGUMENT, OUT_OF_MEMORY. `copy` gets NULL where the call fails. */
SPOOLFLOW_API spoolflow_result spoolflow_copy(const spoolflow_sensor* sensor, spoolflow_sensor** copy);

/* Ends a sensor; NULL is allowed. */
SPOOLFLOW_API void spoolflow_destroy(spoolflow_sensor* sensor);

/* Which sensor runs: SPOOLFLOW_CONDENSED or SPOOLFLOW_OBSERVER. `sensor` must not be NULL, here and in the next three. */
SPOOLFLOW_API spoolflow_estimator spoolflow_runs(const spoolflow_sensor* sensor);

/* The valve's name from its model, UTF-8; lives as long as the sensor. */
SPOOLFLOW_API const char* spoolflow_valve_name(const spoolflow_sensor* sensor);

/* The valve's rated flow [m3/s]: full scale of every figure in percent. */
SPOOLFLOW_API double spoolflow_rated_flow(const spoolflow_sensor* sensor);

/* Whether the model is of a whole 4/3 valve: 1, with signed flow; 0: of one direction of flow. */
SPOOLFLOW_API int spoolflow_is_whole(const spoolflow_sensor* sensor);

/* One sample in, one estimate out; allocates nothing. Of a whole valve current and voltage are those of the active coil:
 * solenoid a where the position is < 0, else solenoid b; the other is taken to carry no current.
 * The first sample's time is any time. After it,
 *   a repeated time:          the sample counts as a second look at the same instant; status has TIME_FAULT;
 *   a time that runs back:    the last answer is held with TIME_FAULT, and time goes on from there;
 *   a NaN or infinite time:   the last answer is held with TIME_FAULT;
 *   current or position NaN:  the last flow is held with SAMPLE_MISSING and a band that opens for as long as that lasts;
 *                             the sensor recovers with the next complete sample. Before the first complete sample the flow is 0 with a band up to the rated flow.
 *   a current or voltage far beyond what calibration saw counts as missing, with COIL_FAULT.
 * Returns SPOOLFLOW_OK, or BAD_ARGUMENT where a pointer is NULL; faults of the inputs are in the status alone. */
SPOOLFLOW_API spoolflow_result spoolflow_step(spoolflow_sensor* sensor, const spoolflow_sample* sample,
                                              spoolflow_estimate* estimate);

/* One sample of what the electronics of a whole 4/3 valve have. */
typedef struct spoolflow_whole_sample {
  double time_s;            /* as in spoolflow_sample */
  double current_a_A;       /* coil currents, means since the sample before; NaN: missing */
  double current_b_A;
  double voltage_a_V;       /* coil voltages, means since the sample before; NaN: not measured */
  double voltage_b_V;
  double position_m;        /* spool position from the centre, > 0 opens P to B, < 0 opens P to A */
  double oil_temperature_K; /* 0 degC is 273.15; NaN: not measured, the last one is held, at first the calibration's middle */
} spoolflow_whole_sample;

/* One sample of a whole valve in, one estimate out; allocates nothing. It may alternate with spoolflow_step. Times and
 * missing inputs are as there; where either current is NaN, the last answer is held with SAMPLE_MISSING.
 * Returns SPOOLFLOW_OK, or BAD_ARGUMENT where a pointer is NULL or the model is of one direction. */
SPOOLFLOW_API spoolflow_result spoolflow_step_whole(spoolflow_sensor* sensor, const spoolflow_whole_sample* sample,
                                                    spoolflow_estimate* estimate);

/* Pressures [Pa] at a whole valve's ports; used only if all four are given; NaN: not measured. */
typedef struct spoolflow_port_pressures {
  double p_Pa;
  double a_Pa;
  double b_Pa;
  double t_Pa;
} spoolflow_port_pressures;

/* As spoolflow_step_whole, with the pressures measured at the ports: the observer then takes the flow from them and its
 * metering edges, with its sign where a load drives the oil, and learns friction meanwhile. `ports` may be NULL: not
 * measured. Returns SPOOLFLOW_OK, or BAD_ARGUMENT where another pointer is NULL or the model is of one direction. */
SPOOLFLOW_API spoolflow_result spoolflow_step_whole_ports(spoolflow_sensor* sensor,
                                                          const spoolflow_whole_sample* sample,
                                                          const spoolflow_port_pressures* ports,
                                                          spoolflow_estimate* estimate);

/* Columns of samples, `count` entries each. voltage_V and oil_temperature_K may be NULL: not measured. */
typedef struct spoolflow_inputs {
  const double* time_s;
  const double* current_A;
  const double* voltage_V;
  const double* position_m;
  const double* oil_temperature_K;
} spoolflow_inputs;

/* Columns to fill, `count` entries each. Any may be NULL: not wanted. */
typedef struct spoolflow_outputs {
  double* flow_m3_per_s;
  double* flow_lower_m3_per_s;
  double* flow_upper_m3_per_s;
  double* pressure_difference_Pa;
  double* magnetic_force_N;
  double* spring_force_N;
  double* flow_force_N;
  double* friction_force_N;
  uint32_t* status;
} spoolflow_outputs;

/* `count` samples one after the other, exactly as that many calls of spoolflow_step; a recording may come in parts.
 * Returns SPOOLFLOW_OK, or BAD_ARGUMENT where a required pointer is NULL. */
SPOOLFLOW_API spoolflow_result spoolflow_step_arrays(spoolflow_sensor* sensor, size_t count,
                                                     const spoolflow_inputs* inputs, const spoolflow_outputs* outputs);

/* Columns of a whole valve's samples, `count` entries each. Voltages and oil_temperature_K may be NULL: not measured. */
typedef struct spoolflow_whole_inputs {
  const double* time_s;
  const double* current_a_A;
  const double* current_b_A;
  const double* voltage_a_V;
  const double* voltage_b_V;
  const double* position_m;
  const double* oil_temperature_K;
} spoolflow_whole_inputs;

/* `count` samples one after the other, exactly as that many calls of spoolflow_step_whole. Returns SPOOLFLOW_OK, or
 * BAD_ARGUMENT where a required pointer is NULL or the model is of one direction. */
SPOOLFLOW_API spoolflow_result spoolflow_step_whole_arrays(spoolflow_sensor* sensor, size_t count,
                                                           const spoolflow_whole_inputs* inputs,
                                                           const spoolflow_outputs* outputs);

/* Back to the state after creation. NULL gives BAD_ARGUMENT. */
SPOOLFLOW_API spoolflow_result spoolflow_reset(spoolflow_sensor* sensor);

/* Bytes that spoolflow_get_state writes for this sensor (some kilobytes); 0 for NULL. */
SPOOLFLOW_API size_t spoolflow_state_size(const spoolflow_sensor* sensor);

/* Writes everything the sensor remembers into `bytes`, to be kept in memory or in a file.
 * Returns SPOOLFLOW_OK, BAD_ARGUMENT, or TOO_SMALL where `size` is below spoolflow_state_size. */
SPOOLFLOW_API spoolflow_result spoolflow_get_state(const spoolflow_sensor* sensor, void* bytes, size_t size);

/* Puts a sensor into a state that spoolflow_get_state wrote, by the same version of the library on the same kind of
 * machine, for the same model and estimator; checked by a checksum. The sensor is untouched where the call fails.
 * Returns SPOOLFLOW_OK, BAD_ARGUMENT, BAD_STATE. */
SPOOLFLOW_API spoolflow_result spoolflow_set_state(spoolflow_sensor* sensor, const void* bytes, size_t size,
                                                   char* message, size_t message_size);

/* The written name of one status bit, such as "spool_at_rest"; NULL for 0, for several bits, and for an unknown bit. */
SPOOLFLOW_API const char* spoolflow_status_name(uint32_t bit);

/* Writes the names of all bits that are set, joined by '|' (empty when all is well): at most `size` bytes, always ended by
 * 0 where size > 0. Returns the length of the whole text without that 0, as snprintf does. */
SPOOLFLOW_API size_t spoolflow_status_text(uint32_t status, char* text, size_t size);

/* A result as text, such as "bad model"; lives as long as the program. */
SPOOLFLOW_API const char* spoolflow_result_text(spoolflow_result result);

/* NOLINTEND(modernize-use-using) */

#ifdef __cplusplus
}
#endif

#endif
