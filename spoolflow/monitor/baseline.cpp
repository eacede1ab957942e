#include "spoolflow/monitor/baseline.hpp"

#include <charconv>
#include <cmath>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "spoolflow/model/json_text.hpp"
#include "spoolflow/model/model_error.hpp"
#include "spoolflow/numerics/checksum.hpp"

namespace spoolflow::monitor {
namespace {

void add(numerics::Checksum& sum, const sensor::ObserverParameters<double>& valve) {
  const auto add_all = [&](std::span<const double> numbers) { sum.add(numbers.data(), numbers.size_bytes()); };
  add_all(valve.actuator.magnetic_force.map.values);
  add_all(valve.actuator.coil.flux_linkage.map.values);
  sum.add(&valve.actuator.coil_resistance.resistance_Ohm, sizeof(double));
  add_all(valve.actuator.friction_N.values);
  add_all(valve.spring.curve.values);
  add_all(valve.edge.flow_force_N.values);
  add_all(valve.edge.friction_N.values);
  add_all(valve.edge.conductance.values);
  for (const double* each :
       {&valve.position_sensor.drift_m_per_K, &valve.friction.operation_ratio, &valve.closed_below_m})
    sum.add(each, sizeof *each);
}

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 2> side_names{"b", "a"};
constexpr double most_centre = 50;  // usual faults

Json side_json(const DirectionBaseline& side) {
  return {{"windows", side.windows},
          {"resistance_Ohm", side.resistance_Ohm},
          {"centre", side.centre},
          {"spread", side.spread}};
}

[[noreturn]] void refuse(const std::string& file, const std::string& path, const std::string& what) {
  throw model::ModelError(file + ": " + path + ": " + what +
                          "; a baseline is what `spoolflow monitor --json` writes of healthy runs");
}

double number(const Json& of, const std::string& file, const std::string& path, const char* name, double most) {
  const auto found = of.find(name);
  if (found == of.end() || !found->is_number()) refuse(file, path + "/" + name, "a number is missing");
  const double value = found->get<double>();
  if (!(value >= 0) || value > most) refuse(file, path + "/" + name, "the number is out of range");
  return value;
}

Magnitudes numbers(const Json& of, const std::string& file, const std::string& path, const char* name, double least,
                   double most) {
  const auto found = of.find(name);
  if (found == of.end() || !found->is_array() || found->size() != magnitudes)
    refuse(file, path + "/" + name, "six numbers are wanted");
  Magnitudes out{};
  for (std::size_t k = 0; k < magnitudes; ++k) {
    const Json& value = (*found)[k];
    if (!value.is_number() || !(value.get<double>() >= least) || value.get<double>() > most)
      refuse(file, path + "/" + name, "a number is out of range");
    out[k] = value.get<double>();
  }
  return out;
}

}  // namespace

std::uint64_t fingerprint(const model::Model& model) {
  numerics::Checksum sum;
  if (model.observer) add(sum, model.observer->parameters);
  if (model.p_to_a && model.p_to_a->observer) add(sum, model.p_to_a->observer->parameters);
  return sum.value();
}

std::string baseline_text(const Baseline& baseline) {
  Json out{{"model", fmt::format("{:x}", baseline.model)}};
  for (std::size_t k = 0; k < side_names.size(); ++k) {
    if (baseline.side[k].windows > 0) out[side_names[k]] = side_json(baseline.side[k]);
  }
  if (baseline.dither_frequency_Hz > 0)
    out["dither"] = {{"amplitude_A", baseline.dither_amplitude_A}, {"frequency_Hz", baseline.dither_frequency_Hz}};
  return out.dump();
}

Baseline parse_baseline(const std::string& text, const std::string& file) {
  const Json json = model::parsed_json(text, file);
  if (json.is_discarded() || !json.is_object()) refuse(file, "/", "this is no JSON object");
  const auto found = json.find("baseline");
  if (found == json.end() || !found->is_object()) refuse(file, "/baseline", "there is none");
  const auto model = found->find("model");
  if (model == found->end() || !model->is_string())
    refuse(file, "/baseline/model", "the model's fingerprint is missing");
  Baseline out;
  const std::string digits = model->get<std::string>();
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), out.model, 16);
  if (error != std::errc() || end != digits.data() + digits.size())
    refuse(file, "/baseline/model", "\"" + digits + "\" is no fingerprint");
  bool any = false;
  for (std::size_t k = 0; k < side_names.size(); ++k) {
    const auto side = found->find(side_names[k]);
    if (side == found->end()) continue;
    const std::string path = std::string("/baseline/") + side_names[k];
    out.side[k].windows = number(*side, file, path, "windows", 1e15);
    out.side[k].resistance_Ohm = number(*side, file, path, "resistance_Ohm", 1e6);
    out.side[k].centre = numbers(*side, file, path, "centre", -most_centre, most_centre);
    out.side[k].spread = numbers(*side, file, path, "spread", 1e-3, most_centre);
    any = true;
  }
  if (const auto dither = found->find("dither"); dither != found->end()) {
    out.dither_amplitude_A = number(*dither, file, "/baseline/dither", "amplitude_A", 1e3);
    out.dither_frequency_Hz = number(*dither, file, "/baseline/dither", "frequency_Hz", 1e5);
  }
  if (!any) refuse(file, "/baseline", "the runs that it was made from have no indicator");
  return out;
}

}  // namespace spoolflow::monitor
