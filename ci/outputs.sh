#!/bin/sh
# What a user gets of the examples, before and after a change that is to change none of it.
#
#   ci/outputs.sh make DIR [BUILD]                   makes all outputs into DIR, which must not be there yet. Of this tree, which is
#                                                    built first; or of BUILD, a build folder of any tree, taken as it is
#                                                    (its targets spoolflow and estimate_in_c)
#   ci/outputs.sh compare A B [--tolerance RELATIVE] names what differs between two such folders; exit status 1 where anything does
#   ci/outputs.sh step NAME                          one step, in a folder that `make` has begun; used by `make`
#
# DIR holds one folder a step, with files and what the command said (NAME.txt: both outputs and the exit status). Examples are
# those of the tree in which this script stands. A fixed SOURCE_DATE_EPOCH keeps dates, and the checksums of models, from
# differing; what else `compare` leaves out stands in ci/compare_outputs.py. Two minutes of one core, 270 MB.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(dirname "$here")
steps="campaign_size_6 demo_whole analyse campaign_fast_dither campaign_size_10 simulate validate estimate export fmu_sensor fmu_valve c_interface
inspect refused help"

# said NAME COMMAND…: runs it and keeps what it says and its exit status in NAME.txt.
said() {
  name=$1
  shift
  status=0
  "$@" >"$name.txt" 2>"$name.err" </dev/null || status=$?
  { echo "-- standard error:"; cat "$name.err"; echo "-- exit status $status"; } >>"$name.txt"
  rm "$name.err"
}

# What all later steps need: the model of the example and the demonstration's files, at once.
valve_a() {
  said calibrate spoolflow calibrate examples/valve_a/campaign.toml -o valve_a/model.json --report valve_a/calibration.html
}
demo() { said said spoolflow demo size_6 -o demo; }

step_campaign_size_6() {
  said campaign spoolflow campaign size_6 -o bench
  said calibrate spoolflow calibrate bench/campaign.toml -o model.json --report calibration.html --units gal/min,psi,in,lbf,F
  said estimate spoolflow estimate model.json bench/duty_cycle_1.csv bench/fast_motion.csv bench/dither.csv -o estimates
  said validate spoolflow validate model.json bench/temperature_sweep.csv bench/pressure_steps.csv bench/sine_sweep.csv \
    bench/fast_motion.csv --json metrics.json --report report.html
}
step_demo_whole() { said said spoolflow demo -o whole; }
step_campaign_size_10() { short_bench size_10; }
step_campaign_fast_dither() { short_bench fast_dither; }
short_bench() {
  printf 'preset = "%s"\n[campaign]\noil_temperatures_C = [30, 60]\npressure_differences_bar = [5, 15, 30]\n' "$1" >valve.toml
  said campaign spoolflow campaign valve.toml -o bench --calibration-only
  said calibrate spoolflow calibrate bench/campaign.toml -o model.json
}

step_simulate() {
  for scenario in ../examples/scenarios/*.toml; do
    name=$(basename "$scenario" .toml)
    said "$name" spoolflow simulate "$scenario" -o "$name.csv" --truth "${name}_truth.csv"
  done
}

step_inspect() {
  for file in ../examples/valve_a/*.h5 ../demo/duty_cycle.csv; do said "$(basename "$file")" spoolflow inspect "$file"; done
  said json spoolflow inspect ../examples/valve_a/ramp_60bar.h5 --json
}

step_estimate() {
  for run in ramp_60bar duty_cycle_1; do
    for estimator in observer condensed; do
      said "${run}_$estimator" spoolflow estimate ../valve_a/model.json "../examples/valve_a/$run.h5" --estimator $estimator \
        -o "${run}_$estimator.csv"
    done
  done
  for missing in voltage:5 temperature:6 both:5,6; do
    cut -d, --complement -f ${missing#*:} ../demo/duty_cycle.csv >run.csv
    missing=${missing%:*}
    said without_$missing spoolflow estimate ../demo/model.json run.csv -o without_$missing.csv
    rm run.csv
  done
  for estimator in observer condensed; do
    said "piped_$estimator" sh -c "spoolflow estimate ../demo/model.json - --estimator $estimator -o - <../demo/duty_cycle.csv >piped_$estimator.csv"
  done
  said several spoolflow estimate ../valve_a/model.json ../examples/valve_a/ramp_60bar.h5 ../examples/valve_a/duty_cycle_1.h5 -o several
}

step_validate() {
  runs="../examples/valve_a/ramp_60bar.h5 ../examples/valve_a/duty_cycle_1.h5"
  said plain spoolflow validate ../valve_a/model.json $runs --json metrics.json --report report.html
  said judged spoolflow validate ../valve_a/model.json $runs --units gal/min,psi,in,lbf,F --requirements ../limits.toml \
    --compare ../demo/metrics.json --json judged.json --report judged.html
  said lagged spoolflow validate ../valve_a/model.json $runs --apply-reference-lag --reference-lag-ms 20 --estimator observer --json lagged.json
  cut -d, --complement -f 5 ../demo/duty_cycle.csv >run.csv
  said without_voltage spoolflow validate ../demo/model.json run.csv --json without_voltage.json
  rm run.csv
}

step_analyse() {
  said plain spoolflow analyse ../valve_a/model.json --scenario ../scenario.toml --recording ../examples/valve_a/ramp_60bar.h5 --jobs 1 \
    --json analysis.json --report analysis.html
  said scenario spoolflow analyse --print-scenario
  said ishigami spoolflow analyse --self-check ishigami --json ishigami.json
}

step_export() {
  said cpp spoolflow export cpp ../valve_a/model.json -o cpp
  for program in self_test example; do
    said $program sh -c "c++ -std=c++20 -O1 -Icpp cpp/$program.cpp -o $program && ./$program"
    rm -f $program
  done
}

# fmu WHAT [RECORDING]: exports it for both versions, unpacks it and lets it answer at other communication steps; binaries go.
fmu() {
  of=$1
  shift
  for version in 2 3; do
    said export_$version spoolflow export fmu "$of" -o $version.fmu --fmi $version
    python3 -m zipfile -e $version.fmu $version
    rm $version.fmu
  done
  said answer_2 python3 "$here/fmu_answers.py" 2 answers_2.csv 1 "$@"
  said answer_3 python3 "$here/fmu_answers.py" 3 answers_3.csv 0.7 "$@"
  if [ $# -gt 0 ]; then said without_voltage python3 "$here/fmu_answers.py" 3 without_voltage.csv 4 "$@" use_voltage; fi
  rm -r 2/binaries 3/binaries
}

step_fmu_sensor() { fmu ../valve_a/model.json ../demo/duty_cycle.csv; }
step_fmu_valve() { fmu size_6; }

step_c_interface() {
  SPOOLFLOW_LIBRARY=$(find "$BUILD/" -name libspoolflow.so.0 | head -n 1)
  export SPOOLFLOW_LIBRARY
  for recording in all without_voltage; do
    if [ $recording = all ]; then cp ../demo/duty_cycle.csv in.csv; else cut -d, --complement -f 5 ../demo/duty_cycle.csv >in.csv; fi
    said c_$recording sh -c "'$BUILD/examples/estimate_in_c' ../demo/model.json <in.csv >c_$recording.csv"
    said python_$recording sh -c "python3 '$root/examples/c_interface/estimate.py' ../demo/model.json <in.csv >python_$recording.csv"
    rm in.csv
  done
  said no_model "$BUILD/examples/estimate_in_c" missing.json
}

step_refused() {
  run=../examples/valve_a/ramp_60bar.h5
  head -n 50 ../demo/duty_cycle.csv >good.csv
  sed '7s/,[^,]*/,overload/3' good.csv >text.csv
  sed '7s/^[^,]*/0.0001/' good.csv >backwards.csv
  sed '1s/current_A/current_bar/' good.csv >unit.csv
  sed '1s/current_A/I/' good.csv >channel.csv
  head -n 1 good.csv >header.csv
  : >empty.csv
  head -c 5000 ../valve_a/model.json >cut.json
  sed 's/"stroke_m": [0-9.e-]*/"stroke_m": -1/' ../valve_a/model.json >negative.json
  sed 's/"version": 1/"version": 99/' ../valve_a/model.json >version.json
  sed 's/protocol = "spring"/protocol = "sprung"/; s,file = ",&../../examples/valve_a/,' ../examples/valve_a/campaign.toml >protocol.toml
  sed '/spring/d; s,file = ",&../examples/valve_a/,' ../examples/valve_a/campaign.toml >key.toml
  for bad in text backwards unit channel header empty missing; do said $bad spoolflow estimate ../valve_a/model.json $bad.csv -o out.csv; done
  for bad in cut negative version missing; do said model_$bad spoolflow estimate $bad.json good.csv -o out.csv; done
  for bad in protocol key missing; do said campaign_$bad spoolflow calibrate $bad.toml --allow-outside -o out.json; done
  said calibrated_of_a_model spoolflow calibrate ../valve_a/model.json -o out.json
  said several spoolflow estimate ../valve_a/model.json missing.csv text.csv good.csv -o several
  said units spoolflow validate ../valve_a/model.json $run --report out.html --units furlong
  said lag spoolflow validate ../valve_a/model.json $run --json - --reference-lag-ms -1
  said limits spoolflow validate ../valve_a/model.json $run --json - --requirements good.csv
  said scenario spoolflow simulate good.csv -o out.csv
  said valve spoolflow campaign size_7 -o out
  said fmu spoolflow export fmu good.csv -o out.fmu
  said folder spoolflow estimate ../valve_a/model.json good.csv -o nowhere/out.csv
  said command spoolflow estimat
  said nothing spoolflow
  rm good.csv text.csv backwards.csv unit.csv channel.csv header.csv empty.csv cut.json negative.json version.json protocol.toml key.toml
}

step_help() {
  said version spoolflow --version
  said spoolflow spoolflow --help
  for page in demo inspect calibrate estimate validate simulate campaign analyse export; do said $page spoolflow $page --help; done
}

# Files of a user's own that steps read.
write_inputs() {
  cat >limits.toml <<'END'
[[limit]]
figure = "p95"
at_most = 5
[[limit]]
run = "each"
figure = "largest"
at_most = 15
unit = "L/min"
[[limit]]
run = "duty_cycle_1"
when = "rest"
figure = "rms"
at_most = 3
[[limit]]
figure = "band_coverage"
at_least = 93
at_most = 99
END
  cat >scenario.toml <<'END'
[points]
positions_percent = [50, 95]
pressure_differences_bar = [20]
[monte_carlo]
trials = 500
trials_along_run = 20
[map]
positions = 5
pressure_differences = 4
[study]
base_samples = 2
run_s = 2
END
}

run_step() {
  begun=$(date +%s)
  mkdir -p "$1"
  cd "$1"
  "step_$1"
  echo "  $1: $(($(date +%s) - begun)) s" >&2
}

make_all() {
  directory=$1
  if [ $# -gt 1 ]; then
    BUILD=$(cd "$2" && pwd)
  else
    "$here/build.sh" release spoolflow
    "$here/build.sh" release estimate_in_c
    BUILD=$root/build/release
  fi
  for needed in bin/spoolflow examples/estimate_in_c; do
    if [ ! -x "$BUILD/$needed" ]; then echo "$BUILD/$needed is missing: ninja -C $BUILD spoolflow estimate_in_c" >&2; exit 2; fi
  done
  mkdir -p "$(dirname "$directory")"
  mkdir "$directory"
  cd "$directory"
  mkdir bin valve_a
  ln -s "$BUILD/bin/spoolflow" bin/spoolflow
  ln -s "$root/examples" examples
  PATH=$PWD/bin:$PATH SOURCE_DATE_EPOCH=1700000000 LC_ALL=C.UTF-8
  export BUILD PATH SOURCE_DATE_EPOCH LC_ALL
  write_inputs
  echo "outputs of $BUILD" >&2
  demo &
  demo_is=$!
  valve_a
  mv calibrate.txt valve_a/
  wait $demo_is
  mv said.txt demo/
  echo $steps | tr ' ' '\n' | xargs -P 2 -I NAME "$here/outputs.sh" step NAME
  rm bin/spoolflow examples
  rmdir bin
}

case ${1-} in
  make) if [ $# -eq 2 ] || [ $# -eq 3 ]; then shift; make_all "$@"; exit; fi ;;
  compare) if [ $# -ge 3 ]; then shift; exec python3 "$here/compare_outputs.py" "$@"; fi ;;
  step) if [ $# -eq 2 ]; then run_step "$2"; exit; fi ;;
esac
sed -n '4,8s/^# *//p' "$0" >&2
exit 2
