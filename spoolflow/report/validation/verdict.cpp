#include "spoolflow/report/validation/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "spoolflow/model/residual_of.hpp"
#include "spoolflow/report/text/number_text.hpp"

namespace spoolflow::report {
namespace {

using validation::Quantity;

/// Figures of one validation in words.
class Judge {
 public:
  Judge(const model::Model& model, const validation::Validation& validation)
      : validation_(validation), percent_(100 / model.valve.rated_flow_m3_per_s) {}

  [[nodiscard]] Text sentence() const;
  [[nodiscard]] std::vector<Text> limits() const;

 private:
  [[nodiscard]] std::string percent(double flow_m3_per_s) const { return fixed(flow_m3_per_s * percent_, 1) + " %"; }
  [[nodiscard]] const validation::PooledResult& leading() const { return validation_.pooled.back(); }
  [[nodiscard]] std::string leading_name() const { return std::string(estimation::name(leading().estimator)); }
  [[nodiscard]] const validation::RunResult* run_of_largest_error() const;
  void add_phases(std::vector<Text>& out) const;
  void add_sign(std::vector<Text>& out) const;
  void add_worst_bins(std::vector<Text>& out) const;
  /// `grave`: faults that last; they come first.
  void add_status(std::vector<Text>& out, bool grave) const;
  void add_band(std::vector<Text>& out) const;
  void add_bands_of_runs(std::vector<Text>& out) const;
  void add_known_runs(std::vector<Text>& out) const;

  const validation::Validation& validation_;
  double percent_;
};

const validation::RunResult* Judge::run_of_largest_error() const {
  const validation::RunResult* out = nullptr;
  double largest = -1;
  for (const validation::RunResult& run : validation_.runs) {
    if (run.calibrated_with && validation_.held_out) continue;
    const auto& worst = run.results.back().worst;
    if (worst && std::abs(worst->error_m3_per_s) > largest) largest = std::abs(worst->error_m3_per_s), out = &run;
  }
  return out;
}

Text Judge::sentence() const {
  if (!leading().metrics) {
    return fmt::format(
        "The {} was run over {} recording{}; none has a reference flow, so how wrong it is cannot be told.",
        leading_name(), validation_.runs.size(), validation_.runs.size() == 1 ? "" : "s");
  }
  const validation::ErrorFigures& error = leading().metrics->all.error;
  Text out =
      phrase("{}95 % of the {}'s errors lie within {} of full scale ({})",
             validation_.held_out ? "" : "No independent test, the calibration knows every run: ", leading_name(),
             percent(error.p95), fixed(units::flow(error.p95), 1));
  if (validation_.pooled.size() > 1) {
    out += fmt::format(", those of the {} sensor within {}", estimation::name(validation_.pooled.front().estimator),
                       percent(validation_.pooled.front().metrics->all.error.p95));
  }
  const validation::RunResult* run = run_of_largest_error();
  out += fmt::format(". The largest error is {}{}.", percent(error.largest),
                     validation_.runs.size() > 1 && run != nullptr ? ", in " + run->name : "");
  return out;
}

void Judge::add_phases(std::vector<Text>& out) const {
  const validation::Metrics& metrics = *leading().metrics;
  const validation::ErrorFigures& rest = metrics.rest.error;
  const validation::ErrorFigures& moving = metrics.moving.error;
  if (rest.samples > 0 && moving.samples > 0 && rest.p95 > 1.15 * moving.p95) {
    out.emplace_back(
        fmt::format("At rest 95 % of the errors lie within {}, in motion within {}: friction at rest lies "
                    "anywhere within its limits, and the force does not tell where.",
                    percent(rest.p95), percent(moving.p95)));
  } else if (rest.samples > 0 && moving.samples > 0 && moving.p95 > 1.15 * rest.p95) {
    out.emplace_back(fmt::format("In motion 95 % of the errors lie within {}, at rest within {}.", percent(moving.p95),
                                 percent(rest.p95)));
  }
  const validation::ErrorFigures& reversal = metrics.reversal.error;
  if (reversal.samples > 0 && reversal.p95 > 1.15 * metrics.all.error.p95) {
    out.emplace_back(fmt::format("Around reversals and stops, where friction changes its sign, 95 % lie within {}.",
                                 percent(reversal.p95)));
  }
}

Text place(Quantity quantity, const validation::ProfileBin& bin, bool whole) {
  const auto between = [&](const char* what, units::Kind kind, int decimals) {
    return phrase("{} between {} and {}", what, bare(fixed(units::Quantity{kind, bin.from}, decimals)),
                  fixed(units::Quantity{kind, bin.to}, decimals));
  };
  switch (quantity) {
    case Quantity::flow:
      return between("flow rates", units::Kind::flow, 0);
    case Quantity::position:
      return between(whole || bin.from < 0 ? "positions" : "openings", units::Kind::length, 2);
    case Quantity::pressure_difference:
      return between("pressure differences", units::Kind::pressure, 0);
    case Quantity::oil_temperature:
      break;
  }
  return between("oil temperatures", units::Kind::temperature, 1);
}

void Judge::add_worst_bins(std::vector<Text>& out) const {
  double worst = 1.3 * leading().metrics->all.error.p95;
  Text text;
  for (std::size_t q = 0; q < validation::quantities.size(); ++q) {
    const auto bins = leading().profiles[q].bins();
    if (bins.size() < 3) continue;
    for (const validation::ProfileBin& bin : bins) {
      if (bin.p95_m3_per_s <= worst) continue;
      worst = bin.p95_m3_per_s;
      text = phrase("Worst are {}: 95 % of the errors within {}.",
                    place(validation::quantities[q], bin, leading().sign.has_value()), percent(bin.p95_m3_per_s));
    }
  }
  if (!text.empty()) out.push_back(text);
}

void Judge::add_sign(std::vector<Text>& out) const {
  if (!leading().sign || leading().sign->samples == 0) return;
  const validation::SignFigures& sign = *leading().sign;
  Text text =
      sign.wrong == 0
          ? Text("Nowhere is the direction of the flow wrong")
          : Text(fmt::format("The direction of the flow is wrong in {} of {} samples", sign.wrong, sign.samples));
  text +=
      sign.undetermined == 0
          ? Text(".")
          : Text(fmt::format("; it is called undetermined in {} %, with flow rates of up to {} of full scale.",
                             fixed(100 * static_cast<double>(sign.undetermined) / static_cast<double>(sign.samples), 2),
                             percent(sign.undetermined_largest_m3_per_s)));
  out.push_back(text);
}

void Judge::add_status(std::vector<Text>& out, bool grave) const {
  for (const validation::RunResult& run : validation_.runs) {
    for (const validation::StatusRow& status : run.results.back().status) {
      const bool told = status.fault || (status.name.starts_with("outside") && status.share > 0.05);
      constexpr double grave_share = 0.05;
      if (!told || grave != (status.fault && status.share > grave_share)) continue;
      constexpr double least_share = 5e-5;  // of what two decimals tell
      const std::string percent =
          status.share < least_share ? "less than 0.01" : fixed(100 * status.share, status.share < 0.01 ? 2 : 0);
      out.emplace_back(fmt::format("{}: {} for {} % of the time. {}", run.name, status.name, percent, status.meaning));
    }
  }
}

void Judge::add_band(std::vector<Text>& out) const {
  const validation::GroupFigures& all = leading().metrics->all;
  const char* judgement = all.band_coverage < 0.93   ? "too narrow"
                          : all.band_coverage > 0.99 ? "wider than it need be"
                                                     : "about as wide as it should be";
  out.emplace_back(fmt::format("The 95 % band holds {} % of the samples, {} % FS wide on average: {}.",
                               fixed(100 * all.band_coverage, 1), fixed(all.band_mean_width_m3_per_s * percent_, 1),
                               judgement));
  add_bands_of_runs(out);
}

void Judge::add_bands_of_runs(std::vector<Text>& out) const {
  constexpr double least_coverage = 0.92, most_coverage = 0.99, most_widths = 8;
  std::map<std::string, std::string> narrow, wide;  // by name, whatever the order of the arguments
  for (const validation::RunResult& run : validation_.runs) {
    const auto& metrics = run.results.back().metrics;
    if (!metrics || metrics->all.error.samples == 0) continue;
    const validation::GroupFigures& all = metrics->all;
    const std::string share = fmt::format("{} ({} %)", run.name, fixed(100 * all.band_coverage, 1));
    if (all.band_coverage < least_coverage) narrow[run.name] = share;
    if (all.band_coverage > most_coverage && all.band_mean_width_m3_per_s > most_widths * all.error.rms)
      wide[run.name] = share;
  }
  const auto tell = [&](const std::map<std::string, std::string>& runs, const char* how) {
    std::string names;
    for (const auto& [name, share] : runs) names += (names.empty() ? "" : ", ") + share;
    if (!names.empty()) out.emplace_back(fmt::format("The band is too {} on {}.", how, names));
  };
  tell(narrow, "narrow");
  tell(wide, "wide");
}

void Judge::add_known_runs(std::vector<Text>& out) const {
  std::string names;
  for (const validation::RunResult& run : validation_.runs) {
    if (run.calibrated_with) names += (names.empty() ? "" : ", ") + run.name;
  }
  if (names.empty()) return;
  out.emplace_back("Also an input of the calibration, so no independent test" +
                   std::string(validation_.held_out ? " and not counted: " : ": ") + names + ".");
}

std::vector<Text> Judge::limits() const {
  std::vector<Text> out;
  for (const validation::RunResult& run : validation_.runs) {
    for (const std::string& doubt : run.doubts) out.emplace_back("Doubt: " + doubt + ".");
  }
  const std::size_t doubts = out.size();
  add_status(out, true);
  if (!leading().metrics) {
    add_status(out, false);
  } else {
    add_sign(out);
    add_phases(out);
    add_worst_bins(out);
    add_band(out);
    add_known_runs(out);
    add_status(out, false);
  }
  const std::size_t most = doubts + (leading().sign ? 8 : 7);
  if (out.size() > most) out.resize(most);
  return out;
}

Text residual_text(const model::Model& model, std::string_view of) {
  for (const model::Residual& residual : model.condensed.residuals) {
    if (residual.of != of) continue;
    const std::optional<units::Kind> kind = units::kind_in(residual.unit);
    return kind ? Text(three_digits(units::Quantity{*kind, residual.rms}))
                : Text(three_digits(residual.rms) + " " + residual.unit);
  }
  return "an unknown residual";
}

/// Of both directions.
Verdict whole_calibration_verdict(const model::Model& model) {
  Verdict out;
  out.sentence = "The whole valve: both directions of flow in one model.";
  for (const char* direction : {"b", "a"}) {
    Verdict of_one = calibration_verdict(model::of_direction(model, direction));
    const char* const flow = *direction == 'a' ? "Flow P to A" : "Flow P to B";
    out.limits.push_back(phrase("{}: {}", flow, of_one.sentence));
    for (const Text& limit : of_one.limits) out.limits.push_back(phrase("{}: {}", flow, limit));
  }
  return out;
}

}  // namespace

Verdict verdict(const model::Model& model, const validation::Validation& validation) {
  const Judge judge(model, validation);
  return {judge.sentence(), judge.limits()};
}

Verdict calibration_verdict(const model::Model& model) {
  if (model.whole()) return whole_calibration_verdict(model);
  const model::Condensed& condensed = model.condensed;
  Verdict out;
  out.sentence = phrase(
      "Calibrated {} from {} to {} and up to {}. The maps give the bench's forces back to {} (magnetic) and {} "
      "(axial), its flow to {} RMS.",
      model.observer ? "for the observer and the condensed sensor" : "for the condensed sensor",
      bare(fixed(units::pressure(condensed.pressure_difference_Pa.lower), 0)),
      fixed(units::pressure(condensed.pressure_difference_Pa.upper), 0),
      fixed(units::current(condensed.current_A.upper), 2), residual_text(model, model::of_magnetic_force),
      residual_text(model, model::of_axial_force), residual_text(model, model::of_flow_rate));
  const model::Uniqueness& uniqueness = model.evidence.uniqueness;
  out.limits.push_back(phrase("Below {} of opening the flow force does not tell the flow.",
                              fixed(units::length(uniqueness.blind_below_m), 2)));
  out.limits.push_back(
      uniqueness.ambiguous_at_m.empty()
          ? Text("Nowhere does a higher pressure difference pull less: each force means one flow rate.")
          : phrase("At {} positions a higher pressure difference pulls less, the first at {}: there one force "
                   "means several flow rates.",
                   uniqueness.ambiguous_at_m.size(), fixed(units::length(uniqueness.ambiguous_at_m.front()), 2)));
  if (model.observer && !model.observer->defaults.empty()) {
    std::string names;
    for (const std::string& name : model.observer->defaults) names += (names.empty() ? "" : ", ") + name;
    out.limits.emplace_back("Assumed, because no recording of the campaign shows it: " + names + ".");
  }
  return out;
}

}  // namespace spoolflow::report
