/// What a calibration amounts to, in words.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "spoolflow/model/residual_of.hpp"
#include "spoolflow/report/text/number_text.hpp"
#include "spoolflow/report/validation/verdict.hpp"

namespace spoolflow::report {
namespace {

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
    const std::string flow = fmt::format("Flow {}", model::flow_of(direction));
    out.limits.push_back(phrase("{}: {}", flow, of_one.sentence));
    for (const Text& limit : of_one.limits) out.limits.push_back(phrase("{}: {}", flow, limit));
  }
  return out;
}

}  // namespace

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
  out.limits.push_back(phrase("Below {} of opening the flow force does not determine the flow.",
                              fixed(units::length(uniqueness.blind_below_m), 2)));
  out.limits.push_back(
      uniqueness.ambiguous_at_m.empty()
          ? Text("Nowhere does a higher pressure difference pull less: each force means one flow rate.")
          : phrase("Positions at which a higher pressure difference pulls less: {}, the first at {}; there one force "
                   "means several flow rates.",
                   uniqueness.ambiguous_at_m.size(), fixed(units::length(uniqueness.ambiguous_at_m.front()), 2)));
  const auto& known = model.provenance.quantities;
  const auto scale = std::ranges::find(known, model::scale_of_forces, &model::KnownQuantity::of);
  if (scale != known.end() && scale->how == "inferred") {
    out.limits.emplace_back(
        fmt::format("No force bench measured a newton: forces are inferred from the flow bench, their common scale "
                    "within {:.0f} %. The flow rate does not depend on that scale.",
                    100 * scale->uncertainty_95.value_or(1)));
  }
  if (model.observer && !model.observer->defaults.empty()) {
    out.limits.emplace_back(fmt::format("Assumed, because no recording of the campaign shows it: {}.",
                                        fmt::join(model.observer->defaults, ", ")));
  }
  return out;
}

}  // namespace spoolflow::report
