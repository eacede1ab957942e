/// What the valve itself finds of references of its machine, in single precision and one at a time, of recordings whose
/// volumes the sensor on the host has summed.
///
///     references_in_valve MODEL.json REFERENCES.toml RECORDING...
///
/// Prints, a reference of the file, its verdict, edge width, position zero and leak. MODEL: of one direction, with the
/// observer.
#include <exception>

#include <fmt/format.h>

#include "spoolflow/calibration/references/sensor_view.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/reader.hpp"
#include "spoolflow/sensor/machine_reference.hpp"
#include "spoolflow/units/conversion.hpp"

namespace {

using namespace spoolflow;
using recording::Channel;

std::vector<recording::Recording> read_all(int count, char** files, double stroke_m) {
  recording::ReadOptions options;
  options.required = {Channel::time, Channel::current, Channel::position};
  options.optional = {Channel::voltage, Channel::oil_temperature, Channel::pressure_difference, Channel::flow_reference,
                      Channel::test};
  options.stroke_m = stroke_m;
  std::vector<recording::Recording> out;
  for (int k = 0; k < count; ++k) out.push_back(recording::read_recording(files[k], options));
  return out;
}

/// The references that `number` of the file makes of all recordings, in the valve.
sensor::MachineFinding<float> found(const model::Model& model, const std::vector<recording::Recording>& recordings,
                                    const recording::Reference& reference, sensor::ReferenceState<float>& state) {
  const sensor::ObserverParameters<double>& valve = model.observer->parameters;
  const double rated_m3_per_s = model.valve.rated_flow_m3_per_s;
  const sensor::MachineKnowledge<float> machine{
      static_cast<float>(rated_m3_per_s), static_cast<float>(0.5 * reference.share_uncertainty),
      static_cast<float>(reference.leakage_uncertainty_m3_per_s), static_cast<float>(valve.edge.position_m.first)};
  for (const recording::Recording& recording : recordings) {
    calibration::WatchedRun run{&recording, calibration::passed_oil(reference, 0, recording, valve, rated_m3_per_s)};
    const calibration::SensorView view = calibration::view_through(valve, rated_m3_per_s, {run});
    for (std::size_t k = 0; k < run.oil.size(); ++k) {
      const calibration::PassedOil& oil = run.oil[k];
      static_cast<void>(update(machine, state,
                               {static_cast<float>(oil.volume_m3),
                                static_cast<float>(oil.uncertainty_m3),
                                {static_cast<float>(view.volume_m3[k]), static_cast<float>(oil.end_s - oil.begin_s)}}));
    }
    if (const auto closed_m = calibration::closed_reading_m(valve, recording); closed_m && run.oil.empty())
      static_cast<void>(update_closed(machine, state, static_cast<float>(*closed_m)));
  }
  return finding_of(machine, state);
}

void print(const std::string& name, const sensor::MachineFinding<float>& finding,
           const sensor::ReferenceState<float>& state) {
  constexpr const char* verdicts[] = {"too few", "stays", "moves", "leaks", "less oil", "apart", "more oil"};
  constexpr double percent = 100, um_per_m = 1e6;
  const auto of = [](float value) { return static_cast<double>(value); };
  fmt::print(
      "{}: {}, edge width {:+.1f} +- {:.1f} %, position zero {:+.1f} um, leak {:+.2f} L/min; {} taken, {} apart\n",
      name, verdicts[static_cast<std::size_t>(finding.verdict)], percent * of(finding.edge_width),
      2 * percent * of(finding.edge_width_deviation), um_per_m * of(finding.position_zero_m),
      units::L_per_min_from_m3_per_s(of(finding.leakage_m3_per_s)), state.taken, state.apart);
}

}  // namespace

int main(int count, char** words) {
  if (count < 4) {
    fmt::print(stderr, "usage: references_in_valve MODEL.json REFERENCES.toml RECORDING...\n");
    return 2;
  }
  try {
    const model::Model model = model::read_model(words[1]);
    const std::vector<recording::Recording> recordings = read_all(count - 3, words + 3, model.valve.stroke_m);
    for (const recording::Reference& reference : recording::read_references(words[2])) {
      if (reference.kind == recording::ReferenceKind::closed) continue;
      sensor::ReferenceState<float> state;
      const sensor::MachineFinding<float> finding = found(model, recordings, reference, state);
      print(reference.name, finding, state);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "references_in_valve: {}\n", error.what());
    return 2;
  }
  return 0;
}
