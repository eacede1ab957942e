#include "spoolflow/report/validation/verdict.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/model/residual_of.hpp"
#include "spoolflow/report/text/number_text.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::report {
namespace {

using validation::Quantity;

/// Figures of one validation in the units of the verdict.
class Judge {
 public:
  Judge(const model::Model& model, const validation::Validation& validation)
      : validation_(validation), percent_(100 / model.valve.rated_flow_m3_per_s) {}

  [[nodiscard]] std::string sentence() const;
  [[nodiscard]] std::vector<std::string> limits() const;

 private:
  [[nodiscard]] std::string percent(double flow_m3_per_s) const { return fixed(flow_m3_per_s * percent_, 1) + " %"; }
  [[nodiscard]] const validation::PooledResult& leading() const { return validation_.pooled.back(); }
  [[nodiscard]] std::string leading_name() const { return std::string(estimation::name(leading().estimator)); }
  [[nodiscard]] const validation::RunResult* run_of_largest_error() const;
  void add_phases(std::vector<std::string>& out) const;
  void add_worst_bins(std::vector<std::string>& out) const;
  void add_status(std::vector<std::string>& out) const;
  void add_band(std::vector<std::string>& out) const;
  void add_known_runs(std::vector<std::string>& out) const;

  const validation::Validation& validation_;
  double percent_;
};

const validation::RunResult* Judge::run_of_largest_error() const {
  const validation::RunResult* out = nullptr;
  double largest = -1;
  for (const validation::RunResult& run : validation_.runs) {
    const auto& worst = run.results.back().worst;
    if (worst && std::abs(worst->error_m3_per_s) > largest) largest = std::abs(worst->error_m3_per_s), out = &run;
  }
  return out;
}

std::string Judge::sentence() const {
  if (!leading().metrics) {
    return fmt::format(
        "The {} was run over {} recording{}; none has a reference flow, so how wrong it is cannot be told.",
        leading_name(), validation_.runs.size(), validation_.runs.size() == 1 ? "" : "s");
  }
  const validation::ErrorFigures& error = leading().metrics->all.error;
  std::string out = fmt::format("95 % of the {}'s errors lie within {} of full scale ({} L/min)", leading_name(),
                                percent(error.p95), fixed(units::L_per_min_from_m3_per_s(error.p95), 1));
  if (validation_.pooled.size() > 1) {
    out += fmt::format(", those of the {} sensor within {}", estimation::name(validation_.pooled.front().estimator),
                       percent(validation_.pooled.front().metrics->all.error.p95));
  }
  const validation::RunResult* run = run_of_largest_error();
  out += fmt::format(". The largest error is {}{}.", percent(error.largest),
                     validation_.runs.size() > 1 && run != nullptr ? ", in " + run->name : "");
  return out;
}

void Judge::add_phases(std::vector<std::string>& out) const {
  const validation::Metrics& metrics = *leading().metrics;
  const validation::ErrorFigures& rest = metrics.rest.error;
  const validation::ErrorFigures& moving = metrics.moving.error;
  if (rest.samples > 0 && moving.samples > 0 && rest.p95 > 1.15 * moving.p95) {
    out.push_back(
        fmt::format("At rest 95 % of the errors lie within {}, in motion within {}: friction at rest lies "
                    "anywhere within its limits, and the force does not tell where.",
                    percent(rest.p95), percent(moving.p95)));
  } else if (rest.samples > 0 && moving.samples > 0 && moving.p95 > 1.15 * rest.p95) {
    out.push_back(fmt::format("In motion 95 % of the errors lie within {}, at rest within {}.", percent(moving.p95),
                              percent(rest.p95)));
  }
  const validation::ErrorFigures& reversal = metrics.reversal.error;
  if (reversal.samples > 0 && reversal.p95 > 1.15 * metrics.all.error.p95) {
    out.push_back(fmt::format("Around reversals and stops, where friction changes its sign, 95 % lie within {}.",
                              percent(reversal.p95)));
  }
}

std::string place(Quantity quantity, const validation::ProfileBin& bin) {
  const auto between = [&](double factor, double offset, int decimals, const char* unit) {
    return fmt::format("{} and {} {}", fixed(bin.from * factor + offset, decimals),
                       fixed(bin.to * factor + offset, decimals), unit);
  };
  switch (quantity) {
    case Quantity::flow:
      return "flow rates between " + between(units::litre_per_minute_per_m3_per_s, 0, 0, "L/min");
    case Quantity::position:
      return "openings between " + between(units::millimetre_per_metre, 0, 2, "mm");
    case Quantity::pressure_difference:
      return "pressure differences between " + between(1 / units::pascal_per_bar, 0, 0, "bar");
    case Quantity::oil_temperature:
      break;
  }
  return "oil temperatures between " + between(1, -units::kelvin_at_0_degC, 1, "\u00b0C");
}

void Judge::add_worst_bins(std::vector<std::string>& out) const {
  double worst = 1.3 * leading().metrics->all.error.p95;
  std::string text;
  for (std::size_t q = 0; q < validation::quantities.size(); ++q) {
    const auto bins = leading().profiles[q].bins();
    if (bins.size() < 3) continue;
    for (const validation::ProfileBin& bin : bins) {
      if (bin.p95_m3_per_s <= worst) continue;
      worst = bin.p95_m3_per_s;
      text = fmt::format("Worst are {}: 95 % of the errors within {}.", place(validation::quantities[q], bin),
                         percent(bin.p95_m3_per_s));
    }
  }
  if (!text.empty()) out.push_back(text);
}

void Judge::add_status(std::vector<std::string>& out) const {
  for (const validation::RunResult& run : validation_.runs) {
    for (const validation::StatusRow& status : run.results.back().status) {
      const bool told = status.fault || (status.name.starts_with("outside") && status.share > 0.05);
      if (!told) continue;
      constexpr double least_share = 5e-5;  // of what two decimals tell
      const std::string percent =
          status.share < least_share ? "less than 0.01" : fixed(100 * status.share, status.share < 0.01 ? 2 : 0);
      out.push_back(fmt::format("{}: {} for {} % of the time. {}", run.name, status.name, percent, status.meaning));
    }
  }
}

void Judge::add_band(std::vector<std::string>& out) const {
  const validation::GroupFigures& all = leading().metrics->all;
  const char* judgement = all.band_coverage < 0.93   ? "too narrow"
                          : all.band_coverage > 0.99 ? "wider than it need be"
                                                     : "about as wide as it should be";
  out.push_back(fmt::format("The 95 % band holds {} % of the samples, {} % FS wide on average: {}.",
                            fixed(100 * all.band_coverage, 1), fixed(all.band_mean_width_m3_per_s * percent_, 1),
                            judgement));
}

void Judge::add_known_runs(std::vector<std::string>& out) const {
  std::string names;
  for (const validation::RunResult& run : validation_.runs) {
    if (run.calibrated_with) names += (names.empty() ? "" : ", ") + run.name;
  }
  if (!names.empty()) out.push_back("Also an input of the calibration, so no independent test: " + names + ".");
}

std::vector<std::string> Judge::limits() const {
  std::vector<std::string> out;
  if (!leading().metrics) {
    add_status(out);
  } else {
    add_phases(out);
    add_worst_bins(out);
    add_band(out);
    add_known_runs(out);
    add_status(out);
  }
  constexpr std::size_t most = 5;
  if (out.size() > most) out.resize(most);
  return out;
}

std::string residual_text(const model::Model& model, std::string_view of) {
  for (const model::Residual& residual : model.condensed.residuals) {
    if (residual.of != of) continue;
    const bool flow = residual.unit == "m3/s";
    return fmt::format("{} {}", three_digits(flow ? units::L_per_min_from_m3_per_s(residual.rms) : residual.rms),
                       flow ? "L/min" : residual.unit);
  }
  return "an unknown residual";
}

}  // namespace

Verdict verdict(const model::Model& model, const validation::Validation& validation) {
  const Judge judge(model, validation);
  return {judge.sentence(), judge.limits()};
}

Verdict calibration_verdict(const model::Model& model) {
  const model::Condensed& condensed = model.condensed;
  Verdict out;
  out.sentence = fmt::format(
      "Calibrated {} from {} to {} bar and up to {} A. The maps give the bench's forces back to {} (magnetic) and {} "
      "(axial), its flow to {} RMS.",
      model.observer ? "for the observer and the condensed sensor" : "for the condensed sensor",
      fixed(units::bar_from_Pa(condensed.pressure_difference_Pa.lower), 0),
      fixed(units::bar_from_Pa(condensed.pressure_difference_Pa.upper), 0), fixed(condensed.current_A.upper, 2),
      residual_text(model, model::of_magnetic_force), residual_text(model, model::of_axial_force),
      residual_text(model, model::of_flow_rate));
  const model::Uniqueness& uniqueness = model.evidence.uniqueness;
  out.limits.push_back(fmt::format("Below {} mm of opening the flow force does not tell the flow.",
                                   fixed(units::mm_from_m(uniqueness.blind_below_m), 2)));
  out.limits.push_back(
      uniqueness.ambiguous_at_m.empty()
          ? std::string("Nowhere does a higher pressure difference pull less: each force means one flow rate.")
          : fmt::format("At {} positions a higher pressure difference pulls less, the first at {} mm: there one force "
                        "means several flow rates.",
                        uniqueness.ambiguous_at_m.size(),
                        fixed(units::mm_from_m(uniqueness.ambiguous_at_m.front()), 2)));
  if (model.observer && !model.observer->defaults.empty()) {
    std::string names;
    for (const std::string& name : model.observer->defaults) names += (names.empty() ? "" : ", ") + name;
    out.limits.push_back("Assumed, because no recording of the campaign shows it: " + names + ".");
  }
  return out;
}

}  // namespace spoolflow::report
