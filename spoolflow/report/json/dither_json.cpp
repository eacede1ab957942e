#include <nlohmann/json.hpp>

#include "spoolflow/report/analysis/dither_report.hpp"
#include "spoolflow/report/json/results_json.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::report {
namespace {

using Ordered = nlohmann::ordered_json;

Ordered setting_of(const analysis::DitherStudy& study, std::size_t place, double full_scale_m3_per_s) {
  const analysis::DitherSetting& each = study.settings[place];
  return {{"amplitude_A", study.amplitude_at_A(place)},
          {"frequency_Hz", study.frequency_at_Hz(place)},
          {"band_L_min", units::L_per_min_from_m3_per_s(each.mean_band_m3_per_s)},
          {"band_percent_FS", 100 * each.mean_band_m3_per_s / full_scale_m3_per_s},
          {"motion_um", 1e6 * each.largest_motion_m},
          {"flow_ripple_L_min", units::L_per_min_from_m3_per_s(each.largest_ripple_m3_per_s)},
          {"flow_ripple_percent_FS", 100 * each.largest_ripple_m3_per_s / full_scale_m3_per_s},
          {"within_limit", each.within_limit}};
}

Ordered point_of(const analysis::DitherStudy& study, std::size_t p) {
  const analysis::DitherPoint& point = study.points[p];
  Ordered effects = Ordered::array();
  for (std::size_t place = 0; place < study.settings.size(); ++place) {
    const analysis::DitherEffect& effect = study.effects[p][place];
    effects.push_back({study.amplitude_at_A(place), study.frequency_at_Hz(place), effect.half_swing_N,
                       units::L_per_min_from_m3_per_s(effect.band_m3_per_s), 1e6 * effect.motion_m,
                       units::L_per_min_from_m3_per_s(effect.flow_ripple_m3_per_s), effect.frees});
  }
  return {{"position_mm", units::mm_from_m(point.point.position_m)},
          {"pressure_difference_bar", units::bar_from_Pa(point.point.pressure_difference_Pa)},
          {"oil_temperature_C", units::degC_from_K(point.point.oil_temperature_K)},
          {"holding_current_A", point.current_A},
          {"flow_L_min", units::L_per_min_from_m3_per_s(point.flow_m3_per_s)},
          {"sliding_friction_N", point.sliding_N},
          {"sticking_limit_N", point.sticking_N},
          {"maps_N", point.maps_N},
          {"effects", std::move(effects)}};
}

}  // namespace

void write_dither_json(std::ostream& out, const model::Model& model, const analysis::DitherStudy& study) {
  const double full_scale = model.valve.rated_flow_m3_per_s;
  const DitherVerdict verdict = dither_verdict(model, study);
  Ordered remarks = Ordered::array();
  for (const Text& remark : verdict.remarks) remarks.push_back(remark.str());
  Ordered file{{"format", "spoolflow dither"},
               {"version", 1},
               {"valve", model.valve.name},
               {"direction", model.valve.direction},
               {"full_scale_L_min", units::L_per_min_from_m3_per_s(full_scale)},
               {"largest_current_A", model.observer->parameters.largest_current_A},
               {"shape", study.question.shape == analysis::DitherShape::sine ? "sine" : "square"},
               {"ripple_limit_percent_FS", 100 * study.question.ripple_limit_share},
               {"verdict", verdict.sentence.str()},
               {"remarks", std::move(remarks)},
               {"without_dither", setting_of(study, 0, full_scale)},
               {"recommended", setting_of(study, study.recommended, full_scale)}};
  Ordered settings = Ordered::array();
  for (std::size_t place = 0; place < study.settings.size(); ++place) {
    settings.push_back(setting_of(study, place, full_scale));
  }
  file["settings"] = std::move(settings);
  file["effect_columns"] = {"amplitude_A", "frequency_Hz",      "half_swing_N", "band_L_min",
                            "motion_um",   "flow_ripple_L_min", "frees"};
  Ordered points = Ordered::array();
  for (std::size_t p = 0; p < study.points.size(); ++p) points.push_back(point_of(study, p));
  file["points"] = std::move(points);
  out << file.dump(1) << '\n';
}

}  // namespace spoolflow::report
