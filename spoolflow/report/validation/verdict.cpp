#include "spoolflow/report/validation/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "spoolflow/report/text/number_text.hpp"

namespace spoolflow::report {
namespace {

using validation::Quantity;

/// What is said of the figures, the most harmful first.
enum class Severity {
  doubt,  ///< the data contradict physics
  lasting_fault,
  wrong_sign,
  narrow_band,    ///< the band promises more than it holds
  off_reference,  ///< scale or zero of reference and estimate differ
  where_worst,    ///< in motion, at rest, in some part of the range
  outside,        ///< of what was calibrated
  brief_fault,
  no_test,  ///< runs that the calibration knows
  wide_band,
  none,
};

/// A sentence of the verdict; of the same severity the larger share comes first, then the text decides: the order of
/// the arguments does not.
struct Remark {
  Severity severity;
  double share;
  Text text;
};

/// Figures of one validation in words.
class Judge {
 public:
  Judge(const model::Model& model, const validation::Validation& validation)
      : validation_(validation), percent_(100 / model.valve.rated_flow_m3_per_s) {}

  [[nodiscard]] Text sentence() const;
  [[nodiscard]] std::vector<Text> limits() const;

 private:
  [[nodiscard]] std::string percent(double flow_m3_per_s) const { return two_digits(flow_m3_per_s * percent_) + " %"; }
  [[nodiscard]] const validation::PooledResult& leading() const { return validation_.pooled.back(); }
  [[nodiscard]] std::string leading_name() const { return std::string(estimation::name(leading().estimator)); }
  void add_phases(std::vector<Remark>& out) const;
  void add_sign(std::vector<Remark>& out) const;
  void add_worst_bins(std::vector<Remark>& out) const;
  void add_status(std::vector<Remark>& out) const;
  void add_references(std::vector<Remark>& out) const;
  void add_band(std::vector<Remark>& out) const;
  void add_bands_of_runs(std::vector<Remark>& out) const;
  void add_known_runs(std::vector<Remark>& out) const;

  const validation::Validation& validation_;
  double percent_;
};

Text Judge::sentence() const {
  if (!leading().metrics) {
    return fmt::format("The {} was run over {} recording{}; none has a reference flow, so its error is not known.",
                       leading_name(), validation_.runs.size(), validation_.runs.size() == 1 ? "" : "s");
  }
  const validation::ErrorFigures& error = leading().metrics->all.error;
  Text out =
      phrase("{}95 % of the {}'s errors lie within {} of full scale ({})",
             validation_.held_out ? "" : "No independent test, the calibration knows every run: ", leading_name(),
             percent(error.p95), two_digits(units::flow(error.p95)));
  if (validation_.pooled.size() > 1) {
    out += fmt::format(", those of the {} sensor within {}", estimation::name(validation_.pooled.front().estimator),
                       percent(validation_.pooled.front().metrics->all.error.p95));
  }
  if (validation::pools_several_runs(validation_) && leading().by_sample) {
    out +=
        fmt::format("; this is the mean over runs, {} over all samples", percent(leading().by_sample->all.error.p95));
  }
  const validation::RunResult* run = run_of_largest_error(validation_);
  out += fmt::format(". The largest error is {}{}.", percent(error.largest),
                     validation_.runs.size() > 1 && run != nullptr ? ", in " + run->name : "");
  return out;
}

void Judge::add_phases(std::vector<Remark>& out) const {
  const validation::Metrics& metrics = *leading().metrics;
  const validation::ErrorFigures& rest = metrics.rest.error;
  const validation::ErrorFigures& moving = metrics.moving.error;
  if (rest.samples > 0 && moving.samples > 0 && rest.p95 > 1.15 * moving.p95) {
    out.push_back({Severity::where_worst, rest.p95,
                   fmt::format("At rest 95 % of the errors lie within {}, in motion within {}: friction at rest lies "
                               "anywhere within its limits, which the force does not show.",
                               percent(rest.p95), percent(moving.p95))});
  } else if (rest.samples > 0 && moving.samples > 0 && moving.p95 > 1.15 * rest.p95) {
    out.push_back({Severity::where_worst, moving.p95,
                   fmt::format("In motion 95 % of the errors lie within {}, at rest within {}.", percent(moving.p95),
                               percent(rest.p95))});
  }
  const validation::ErrorFigures& reversal = metrics.reversal.error;
  if (reversal.samples > 0 && reversal.p95 > 1.15 * metrics.all.error.p95) {
    out.push_back({Severity::where_worst, reversal.p95,
                   fmt::format("Around reversals and stops, where friction changes its sign, 95 % lie within {}.",
                               percent(reversal.p95))});
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

void Judge::add_worst_bins(std::vector<Remark>& out) const {
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
  if (!text.empty()) out.push_back({Severity::where_worst, worst, text});
}

void Judge::add_sign(std::vector<Remark>& out) const {
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
  out.push_back({sign.wrong == 0 ? Severity::none : Severity::wrong_sign, 0, text});
}

void Judge::add_status(std::vector<Remark>& out) const {
  for (const validation::RunResult& run : validation_.runs) {
    for (const validation::StatusRow& status : run.results.back().status) {
      if (!status.fault && !(status.name.starts_with("outside") && status.share > 0.05)) continue;
      constexpr double lasting_share = 0.05, least_share = 5e-5;  // the latter: the resolution of two decimals
      const std::string percent =
          status.share < least_share ? "less than 0.01" : fixed(100 * status.share, status.share < 0.01 ? 2 : 0);
      const Severity severity = !status.fault                  ? Severity::outside
                                : status.share > lasting_share ? Severity::lasting_fault
                                                               : Severity::brief_fault;
      out.push_back({severity, status.share,
                     fmt::format("{}: {} for {} % of the time. {}", run.name, status.name, percent, status.meaning)});
    }
  }
}

void Judge::add_references(std::vector<Remark>& out) const {
  constexpr double least_scale = 0.03, least_offset = 0.02;  // the latter: of full scale
  for (const validation::RunResult& run : validation_.runs) {
    if (!run.reference_scale) continue;
    const validation::ReferenceScale& found = *run.reference_scale;
    const double off = std::abs(found.scale - 1), offset = found.offset_m3_per_s * percent_ / 100;
    constexpr double surely = 3;  // standard uncertainties
    const bool scaled = off > std::max(least_scale, surely * found.scale_uncertainty);
    const bool shifted =
        std::abs(found.offset_m3_per_s) > surely * found.offset_uncertainty_m3_per_s && std::abs(offset) > least_offset;
    if (!scaled && !shifted) continue;
    out.push_back(
        {Severity::off_reference, std::max(off, std::abs(offset)),
         fmt::format("{}: the reference reads {} \u00b1 {} times the estimate {} {} \u00b1 {} FS (95 %). Look "
                     "at the meter's factor and zero; nothing of it was applied.",
                     run.name, fixed(found.scale, 3), fixed(2 * found.scale_uncertainty, 3),
                     offset < 0 ? "less" : "plus", two_digits(100 * std::abs(offset)),
                     percent(2 * found.offset_uncertainty_m3_per_s))});
  }
}

void Judge::add_band(std::vector<Remark>& out) const {
  const validation::GroupFigures& all = leading().metrics->all;
  const char* judgement = all.band_coverage < 0.93   ? "too narrow"
                          : all.band_coverage > 0.99 ? "wider than it need be"
                                                     : "about as wide as it should be";
  out.push_back(
      {all.band_coverage < 0.93 ? Severity::narrow_band : Severity::wide_band, 1,
       fmt::format("The 95 % band holds {} % of the samples, {} % FS wide on average: {}.",
                   fixed(100 * all.band_coverage, 1), two_digits(all.band_mean_width_m3_per_s * percent_), judgement)});
  add_bands_of_runs(out);
}

void Judge::add_bands_of_runs(std::vector<Remark>& out) const {
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
  const auto add = [&](const std::map<std::string, std::string>& runs, const char* how, Severity severity) {
    std::string names;
    for (const auto& [name, share] : runs) names += (names.empty() ? "" : ", ") + share;
    if (!names.empty()) out.push_back({severity, 0, fmt::format("The band is too {} on {}.", how, names)});
  };
  add(narrow, "narrow", Severity::narrow_band);
  add(wide, "wide", Severity::wide_band);
}

void Judge::add_known_runs(std::vector<Remark>& out) const {
  std::vector<std::string> known;
  for (const validation::RunResult& run : validation_.runs) {
    if (run.calibrated_with) known.push_back(run.name);
  }
  if (known.empty()) return;
  std::ranges::sort(known);
  out.push_back({Severity::no_test, 0,
                 fmt::format("Also an input of the calibration, so no independent test{}: {}.",
                             validation_.held_out ? " and not counted" : "", fmt::join(known, ", "))});
}

std::vector<Text> Judge::limits() const {
  std::vector<Remark> remarks;
  for (const validation::RunResult& run : validation_.runs) {
    for (const std::string& doubt : run.doubts)
      remarks.push_back({Severity::doubt, 0, Text("Doubt: " + doubt + (doubt.ends_with('?') ? "" : "."))});
  }
  add_status(remarks);
  if (leading().metrics) {
    add_sign(remarks);
    add_phases(remarks);
    add_worst_bins(remarks);
    add_references(remarks);
    add_band(remarks);
    add_known_runs(remarks);
  }
  const auto rank = [](const Remark& remark) { return std::tuple(remark.severity, -remark.share, remark.text.str()); };
  std::ranges::sort(remarks, {}, rank);
  constexpr std::size_t most = 8;
  std::vector<Text> out;
  for (Remark& remark : remarks) {  // what promises too much is always reported, and runs that are no test
    if (remark.severity > Severity::narrow_band && remark.severity != Severity::no_test && out.size() >= most) continue;
    out.push_back(std::move(remark.text));
  }
  return out;
}

}  // namespace

Verdict verdict(const model::Model& model, const validation::Validation& validation) {
  const Judge judge(model, validation);
  std::size_t doubts = 0;
  for (const validation::RunResult& run : validation.runs) doubts += run.doubts.size();
  return {judge.sentence(), judge.limits(), doubts};
}

const validation::RunResult* run_of_largest_error(const validation::Validation& validation) {
  const validation::RunResult* out = nullptr;
  double largest = -1;
  for (const validation::RunResult& run : validation.runs) {
    if (!validation::is_pooled(run, validation)) continue;
    const auto& worst = run.results.back().worst;
    if (!worst) continue;
    const double error = std::abs(worst->error_m3_per_s);
    if (error > largest || (error == largest && run.name < out->name)) largest = error, out = &run;
  }
  return out;
}

std::string reference_meter_text(const validation::RunResult& run) {
  const auto ms = [](double time_s) { return fixed(1e3 * time_s, 1); };
  const auto& [meter, uncertainty, source] = run.reference_meter;
  if (source == validation::MeterSource::none) return "not shown by the run, and counted as 0";
  if (!uncertainty) {
    return fmt::format(
        "{} ms after {} ms of dead time{}", ms(meter.lag_s), ms(meter.dead_time_s),
        source == validation::MeterSource::other_runs ? " as in the other runs, since this one shows none" : "");
  }
  const numerics::MeterLag& width = *uncertainty;
  return fmt::format("{} \u00b1 {} ms after {} \u00b1 {} ms of dead time", ms(meter.lag_s), ms(width.lag_s),
                     ms(meter.dead_time_s), ms(width.dead_time_s));
}

}  // namespace spoolflow::report
