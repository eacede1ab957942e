#!/usr/bin/env python3
"""What each tuning number of the sensor does: 95th percentile of the flow's error and share in the band on each run, with
the number halved and doubled. Numbers are the named constants of spoolflow/sensor and the observer's parameters that no
bench measures.

tuning_evidence.py SPOOLFLOW MODEL.json RECORDING.csv TRUTH.csv [RECORDING.csv TRUTH.csv …] [--markdown | --update]

--update writes what it found into spoolflow/model/tuning_evidence.csv; numbers that it does not vary keep their rows. That file has
the runs temperature_sweep, duty_cycle_1, ramps_30_to_70bar, orifice_duty_dither, ramp_60bar, ramp_60bar_dither, motor_load and
fast_10kHz of valve A.

SPOOLFLOW is the built command: `export cpp` gives the sensor's headers and the model. In the copy of the headers the
constants become variables, so one program tries them all. Needs g++ and nothing else. RECORDING.csv has the columns of
../shared/recordings, TRUTH.csv time_s and flow_L_min at the same times. Judged in single precision.
"""
import array, csv, math, pathlib, re, subprocess, sys, tempfile

CONSTANT = re.compile(r"inline constexpr double (\w+) = ([^;]+);")
PARAMETERS = """friction.ageing_ratio friction.ageing_s friction.contact_stiffness_N_per_m friction.tolerance_N
friction.breakaway_share position_sensor.backlash_m position_sensor.hardest_acceleration_m_per_s2
pressure.sliding_drift_Pa_per_sqrt_s pressure.resting_drift_Pa_per_sqrt_s pressure.least_process_noise
pressure.first_process_noise pressure.constrained_correction_s pressure.force_correlation_s pressure.ratio_deviation
pressure.ratio_memory_s band.friction_share band.coverage_factor band.force_share band.rest_share band.tolerance_N
band.creep_per_s band.unobserved_factor moving_mass_kg""".split()
# of these, how the model file calls them where not by the last name
KEYS = {"friction.ageing_ratio": "friction_ageing_ratio",
        "friction.ageing_s": "friction_ageing_s",
        "friction.tolerance_N": "friction_tolerance_N",
        "position_sensor.backlash_m": "position_backlash_m",
        "pressure.ratio_deviation": "friction_ratio_deviation",
        "pressure.ratio_memory_s": "friction_ratio_memory_s",
        "band.friction_share": "band_friction_share",
        "band.coverage_factor": "band_coverage_factor",
        "band.force_share": "band_force_share",
        "band.rest_share": "band_rest_share",
        "band.tolerance_N": "band_tolerance_N",
        "band.creep_per_s": "band_creep_per_s",
        "band.unobserved_factor": "band_unobserved_factor"}

PROGRAM = """
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>
#include "valve_model.hpp"
using namespace spoolflow::sensor;
using Valve = ObserverParameters<float>;
struct Row { float dt, current, voltage, position, temperature, truth; };
static std::vector<Row> read(const char* file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  std::vector<Row> rows(static_cast<std::size_t>(in.tellg()) / sizeof(Row));
  in.seekg(0).read(reinterpret_cast<char*>(rows.data()), static_cast<std::streamsize>(rows.size() * sizeof(Row)));
  return rows;
}
static void judge(const char* knob, double factor, const Valve& valve, const std::vector<std::vector<Row>>& runs) {
  std::printf("%s %g", knob, factor);
  for (const auto& run : runs) {
    ObserverState<float> state{};
    std::vector<float> errors;
    long inside = 0;
    for (const Row& row : run) {
      const auto& answer = step(valve, state, {row.dt, row.current, row.voltage, row.position, row.temperature});
      errors.push_back(std::abs(answer.flow_m3_per_s - row.truth));
      inside += answer.flow_lower_m3_per_s <= row.truth && row.truth <= answer.flow_upper_m3_per_s;
    }
    const auto p95 = errors.begin() + static_cast<long>(0.95 * static_cast<double>(errors.size()));
    std::nth_element(errors.begin(), p95, errors.end());
    std::printf(" %.3f %.1f", 100.0 * *p95 / valve_model::rated_flow_m3_per_s,
                100.0 * static_cast<double>(inside) / static_cast<double>(run.size()));
  }
  std::printf("\\n");
}
int main(int argc, char** argv) {
  std::vector<std::vector<Row>> runs;
  for (int k = 1; k < argc; ++k) runs.push_back(read(argv[k]));
  judge("as_is", 1, valve_model::parameters, runs);
  for (const double factor : {0.5, 2.0}) {
@TRIALS@  }
}
"""


def fail(message):
    sys.exit(f"tuning_evidence: {message}")


def columns(path, wanted):
    with open(path, newline="") as file:
        rows = csv.reader(file)
        head = next(rows)
        missing = [name for name in wanted if name not in head]
        if missing:
            fail(f"{path}: no column {missing[0]!r}; it has {', '.join(head)}")
        at = [head.index(name) for name in wanted]
        return [[float(row[k]) if row[k] else math.nan for k in at] for row in rows]


def pack(recording, truth, target):
    rows = columns(recording, ("time_s", "current_A", "voltage_V", "position_mm", "oil_temperature_C"))
    flow = columns(truth, ("flow_L_min",))
    if len(rows) != len(flow):
        fail(f"{truth}: {len(flow)} rows for {len(rows)} of {recording}")
    out, last = array.array("f"), rows[0][0]
    for (time, current, voltage, position, temperature), (litres,) in zip(rows, flow):
        out.extend((time - last, current, voltage, position * 1e-3, temperature + 273.15, litres / 60e3))
        last = time
    target.write_bytes(out.tobytes())


def tunable_headers(folder):
    """Makes the constants variables; returns their names."""
    names = []
    for header in sorted((folder / "spoolflow/sensor").glob("*.hpp")):
        if header.name == "dither_request.hpp":
            continue  # no run requests dither
        text = header.read_text()
        names += CONSTANT.findall(text)
        header.write_text(CONSTANT.sub(r"inline double \1 = \2;", text))
    return [name for name, _ in names]


def main():
    arguments = [a for a in sys.argv[1:] if not a.startswith("--")]
    if len(arguments) < 4 or len(arguments) % 2:
        fail(__doc__.split("\n\n")[1])
    spoolflow, model, *files = arguments
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run([spoolflow, "export", "cpp", model, "-o", folder / "cpp"], check=True)
        constants = tunable_headers(folder / "cpp")
        trials = "".join(f'    {{ const double was = {c}; {c} = factor * was; judge("{c}", factor, valve_model::parameters, runs); '
                         f"{c} = was; }}\n" for c in constants)
        trials += "".join(f"    {{ Valve valve = valve_model::parameters; valve.{p} *= static_cast<float>(factor); "
                          f'judge("{p}", factor, valve, runs); }}\n' for p in PARAMETERS)
        (folder / "main.cpp").write_text(PROGRAM.replace("@TRIALS@", trials))
        subprocess.run(["g++", "-std=c++20", "-O2", f"-I{folder / 'cpp'}", folder / "main.cpp", "-o", folder / "trials"], check=True)
        runs = []
        for k in range(0, len(files), 2):
            runs.append(folder / f"run{k}")
            pack(files[k], files[k + 1], runs[-1])
        lines = subprocess.run([folder / "trials", *runs], check=True, capture_output=True, text=True).stdout.split("\n")
    found, names = [line.split() for line in lines if line], [pathlib.Path(f).stem for f in files[::2]]
    if "--update" in sys.argv:
        update(found, names)
    else:
        print_findings(found, names, "--markdown" in sys.argv)


def findings(lines, runs):
    """Of each number: name, the run that shows most of it (none: nothing does), and there p95 and share in the band halved, as it is
    and doubled."""
    found = {(name, factor): [float(v) for v in values] for name, factor, *values in lines}
    base = found["as_is", "1"]
    for name in dict.fromkeys(n for n, _ in found if n != "as_is"):
        half, double = found[name, "0.5"], found[name, "2"]

        def shown(k):
            p95 = max(abs(math.log(max(v[2 * k], 1e-3) / max(base[2 * k], 1e-3))) for v in (half, double))
            return p95 + max(abs(v[2 * k + 1] - base[2 * k + 1]) for v in (half, double)) / 20

        k = max(range(len(runs)), key=shown)
        yield name, runs[k] if shown(k) >= 0.005 else None, [(v[2 * k], v[2 * k + 1]) for v in (half, base, double)]


def print_findings(lines, runs, markdown):
    """One line a number."""
    base = [float(v) for v in lines[0][2:]]
    if not markdown:
        print("as it is:", ", ".join(f"{r} {base[2 * k]:.2f} % FS, {base[2 * k + 1]:.1f} % in band" for k, r in enumerate(runs)))
    else:
        print("| number | run that shows most | halved | as it is | doubled |\n|---|---|---|---|---|")
    for name, run, values in findings(lines, runs):
        cell = [f"{p95:.2f} / {band:.1f} %" for p95, band in values]
        if run is None:
            print(f"| `{name}` | none of these |  |  |  |" if markdown else f"{name:42} nothing")
        else:
            print(f"| `{name}` | {run} | {cell[0]} | {cell[1]} | {cell[2]} |" if markdown else
                  f"{name:42} {run:20} halved {cell[0]:>16}   as is {cell[1]:>16}   doubled {cell[2]:>16}")


def update(lines, runs):
    path = pathlib.Path(__file__).resolve().parent.parent / "spoolflow/model/tuning_evidence.csv"
    with open(path, newline="") as file:
        head, *old = csv.reader(file)
    rows = {row[0]: row for row in old}
    for name, run, values in findings(lines, runs):
        key = KEYS.get(name, name.split(".")[-1])
        if run is None:
            rows[key] = [key] + [""] * 7 + ["none of the runs"]
        else:
            rows[key] = [key, run, *(f"{p95:.2f}" for p95, _ in values), *(f"{band:.1f}" for _, band in values), ""]
    with open(path, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([head, *rows.values()])


if __name__ == "__main__":
    main()
