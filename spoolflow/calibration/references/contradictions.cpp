#include "spoolflow/calibration/references/contradictions.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/references/wear_search.hpp"
#include "spoolflow/numerics/median.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::calibration {
namespace {

/// Between two references, in standard deviations, and what the sensor's own volumes differ by between their intervals.
constexpr double contradiction_deviations = 3.5, between_references_share = 0.005;

/// Of a reference: the numbers of intervals left out, counted from 1, and of all whose oil was compared.
struct Apart {
  std::vector<std::size_t> less, more;
  std::size_t all = 0;
  std::vector<double> seen_shares;  ///< of all its intervals
};

Apart apart_of(const WearView& view, std::size_t r) {
  const double level = level_of(view.ratios, r).log_ratio;
  Apart out;
  std::size_t number = 0;
  for (const OilRatio& each : view.ratios) {
    if (each.reference != r) continue;
    ++number;
    out.seen_shares.push_back(each.seen_share);
    const bool seen = each.used || each.log_ratio != 0;
    out.all += seen;
    if (seen && !each.used) (each.log_ratio < level ? out.less : out.more).push_back(number);
  }
  return out;
}

std::string left_out(const MachineEvidence& evidence, const WearView& view, std::size_t r) {
  const recording::Reference& reference = evidence.references[r];
  const Apart apart = apart_of(view, r);
  if (apart.all == 0) {
    throw CalibrationError(fmt::format(
        "{}: {} is refused: in every interval the sensor sees less than {:.0f} % of its oil pass, or more than "
        "{:.0f} %; check the units of what it states, that model and recording belong together, and that the oil goes "
        "in the model's direction; in the median it sees {:.4g} %",
        reference.place, reference.name, percent * least_seen_share, percent / least_seen_share,
        percent * numerics::median(apart.seen_shares)));
  }
  const std::size_t count = apart.less.size() + apart.more.size();
  if (count == 0) return {};
  const bool metered = reference.kind == recording::ReferenceKind::meter;
  const std::string less = fmt::format("{}", fmt::join(apart.less, ", ")),
                    more = fmt::format("{}", fmt::join(apart.more, ", "));
  std::string what;
  if (!apart.less.empty())
    what = fmt::format("less oil than in the others in {}: likely {}", less,
                       metered ? "oil passed beside the meter" : "another consumer was open");
  if (!apart.more.empty())
    what += fmt::format("{}more oil in {}: likely {}the sensor lost the pressure", what.empty() ? "" : "; ", more,
                        metered ? "" : "ends are marked at other times, or ");
  if (static_cast<double>(count) > most_left_out * static_cast<double>(apart.all)) {
    throw CalibrationError(fmt::format(
        "{}: {} is refused: {} of its {} intervals contradict the others ({}); mark intervals in which this "
        "valve alone is open",
        reference.place, reference.name, count, apart.all, what));
  }
  return fmt::format("{}: {} of {} intervals are left out ({})", reference.name, count, apart.all, what);
}

void require_no_leak(const MachineEvidence& evidence, const WearView& view, std::size_t r) {
  const recording::Reference& reference = evidence.references[r];
  const OilLeak leak = leak_of(view.ratios, r);
  if (leak.gain < contradiction_evidence || !(leak.leak_m3_per_s > reference.leakage_uncertainty_m3_per_s)) return;
  throw CalibrationError(fmt::format(
      "{}: {} is refused: slow intervals miss {:.2g} +- {:.2g} L/min beside fast ones, where {:.2g} L/min was stated; "
      "likely {}",
      reference.place, reference.name, units::L_per_min_from_m3_per_s(leak.leak_m3_per_s),
      units::L_per_min_from_m3_per_s(2 * leak.deviation_m3_per_s),
      units::L_per_min_from_m3_per_s(reference.leakage_uncertainty_m3_per_s),
      reference.kind == recording::ReferenceKind::stroke ? "the seal leaks; mend it, or state its leakage"
      : reference.kind == recording::ReferenceKind::pump ? "the pump leaks more; state its leakage"
                                                         : "the meter's zero is off, or it cuts off low flow; read it "
                                                           "with the valve closed"));
}

double deviation_of(const MachineEvidence& evidence, const OilLevel& level, std::size_t r) {
  return std::hypot(level.deviation, 0.5 * evidence.references[r].share_uncertainty);
}

void require_consistent(const MachineEvidence& evidence, const WearView& view, std::size_t r, std::size_t s) {
  const OilLevel one = level_of(view.ratios, r), other = level_of(view.ratios, s);
  if (one.count == 0 || other.count == 0) return;
  const double expected =
      std::hypot(deviation_of(evidence, one, r), deviation_of(evidence, other, s), between_references_share);
  const double off = other.log_ratio - one.log_ratio;
  if (std::abs(off) <= contradiction_deviations * expected) return;
  throw CalibrationError(
      fmt::format("{}: {} says {:+.1f} % more oil than {}, where {:.1f} % is to be expected; likely an area, a "
                  "displacement or a meter's gain is wrong; correct it, or leave one of them out",
                  evidence.references[s].place, evidence.references[s].name, percent * off, evidence.references[r].name,
                  percent * 2 * expected));
}

/// "area or displacement": what the references state, of which one may be wrong.
std::string stated_by(const MachineEvidence& evidence) {
  std::vector<std::string> out;
  for (const recording::Reference& reference : evidence.references) {
    const char* what = reference.kind == recording::ReferenceKind::stroke ? "area"
                       : reference.kind == recording::ReferenceKind::pump ? "displacement"
                                                                          : "gain";
    if (reference.kind != recording::ReferenceKind::closed && std::ranges::find(out, what) == out.end())
      out.emplace_back(what);
  }
  return fmt::format("{}", fmt::join(out, " or "));
}

/// The share by which it is, where no edge wore.
double too_large(const EdgeChange& edge) {
  return std::exp(edge.oil) - 1;
}

}  // namespace

std::string names_of(const MachineEvidence& evidence) {
  std::vector<std::string> names;
  for (const recording::Reference& reference : evidence.references)
    if (reference.kind != recording::ReferenceKind::closed) names.push_back(reference.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::vector<std::string> require_agreement(const MachineEvidence& evidence, const WearView& view) {
  std::vector<std::string> out;
  for (std::size_t r = 0; r < evidence.references.size(); ++r) {
    if (evidence.references[r].kind == recording::ReferenceKind::closed) continue;
    if (std::string sentence = left_out(evidence, view, r); !sentence.empty()) out.push_back(std::move(sentence));
    require_no_leak(evidence, view, r);
    for (std::size_t s = 0; s < r; ++s) require_consistent(evidence, view, s, r);
  }
  return out;
}

void require_no_less(const MachineEvidence& evidence, const Change& edge) {
  if (!(edge.value < 0) || edge.evidence < contradiction_evidence) return;
  const bool only_meters = std::ranges::all_of(evidence.references, [](const recording::Reference& reference) {
    return reference.kind == recording::ReferenceKind::meter || reference.kind == recording::ReferenceKind::closed;
  });
  throw CalibrationError(
      fmt::format("{} refused: so little oil passed that the edges would be {:.1f} % narrower, and wear widens them; "
                  "likely {}the stated {} is too small",
                  names_of(evidence), percent * (1 - std::exp(edge.value)),
                  only_meters ? "the meter's range ends, or " : "a seal leaks, another consumer is open, or ",
                  stated_by(evidence)));
}

void require_no_misstated(const MachineEvidence& evidence, const EdgeChange& edge) {
  if (!(edge.value > 0) || edge.misstated < contradiction_evidence) return;
  throw CalibrationError(
      fmt::format("{} refused: so much oil passed that the edges would be {:.0f} % wider at once, and a stated {} that "
                  "is {:.0f} % too large is exp({:.1f}) times as likely; correct it; if it is right, give a second "
                  "reference that says the same (another cylinder, a pump, a meter), or calibrate the valve again",
                  names_of(evidence), percent * (std::exp(edge.asked) - 1), stated_by(evidence),
                  percent * too_large(edge), edge.misstated));
}

std::string looks_alike(const MachineEvidence& evidence, const EdgeChange& edge) {
  if (std::isinf(edge.misstated) || !(edge.asked > 0) || !(edge.evidence > 0)) return {};
  return fmt::format(
      "a stated {} that is {:.0f} % too large looks alike (probability {:.0f} %), and the band holds both; check it, "
      "or give a second reference (another cylinder, a pump, a meter)",
      stated_by(evidence), percent * too_large(edge), percent / (1 + std::exp(-edge.misstated)));
}

}  // namespace spoolflow::calibration
