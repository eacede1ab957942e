#include "spoolflow/report/analysis/dither_report.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include <fmt/format.h>

#include "spoolflow/report/calibration/model_sections.hpp"
#include "spoolflow/report/figures/heat_scale.hpp"
#include "spoolflow/report/page/html_page.hpp"
#include "spoolflow/report/text/html_text.hpp"
#include "spoolflow/report/text/number_text.hpp"

namespace spoolflow::report {
namespace {

using analysis::DitherEffect;
using analysis::DitherPoint;
using analysis::DitherSetting;
using analysis::DitherStudy;

constexpr HeatScale band_heat({0, 0.5, 1, 2, 4, 8, 16, 32});            // % FS
constexpr HeatScale ripple_heat({0, 0.05, 0.1, 0.2, 0.35, 0.5, 1, 2});  // % FS

/// Shown as curves: the ends, two between, and the recommended frequency.
std::vector<std::size_t> shown_frequencies(const DitherStudy& study) {
  const std::size_t count = study.frequency_Hz.size();
  std::vector<std::size_t> out{0, count / 3, 2 * count / 3, count - 1, study.recommended % count};
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::string frequency_text(double frequency_Hz) {
  return fixed(frequency_Hz, 0) + " Hz";
}

/// A quantity of each setting over amplitude and frequency, with the recommended setting and the limit of the ripple.
template <class Value>
CaptionedFigure setting_map(const DitherStudy& study, const HeatScale& heat, const std::string& title,
                            const std::string& caption, const Value& percent) {
  const double across_A = study.amplitude_A[1] - study.amplitude_A[0];
  const double up_Hz = study.frequency_Hz[1] - study.frequency_Hz[0];
  Panel panel{.title = "Frequency [Hz]", .height_px = 300};
  panel.lowest = study.frequency_Hz.front() - 0.5 * up_Hz;
  panel.highest = study.frequency_Hz.back() + 0.5 * up_Hz;
  Mark limit{.shape = Shape::line, .tone = "ink", .name = "ripple at its limit", .width_px = 2};
  for (std::size_t f = 0; f < study.frequency_Hz.size(); ++f) {
    std::size_t within = 0;
    for (std::size_t a = 0; a < study.amplitude_A.size(); ++a) {
      const DitherSetting& each = study.settings[study.place(a, f)];
      if (each.within_limit && within == a) within = a + 1;
      panel.cells.push_back({study.amplitude_A[a] - 0.5 * across_A, study.amplitude_A[a] + 0.5 * across_A,
                             study.frequency_Hz[f] - 0.5 * up_Hz, study.frequency_Hz[f] + 0.5 * up_Hz,
                             heat.colour(percent(each))});
    }
    for (const double side : {-0.5, 0.5}) {
      limit.x.push_back(within == study.amplitude_A.size()
                            ? NAN
                            : study.amplitude_A[0] + (static_cast<double>(within) - 0.5) * across_A);
      limit.y.push_back(study.frequency_Hz[f] + side * up_Hz);
    }
  }
  panel.marks.push_back(std::move(limit));
  panel.marks.push_back({.shape = Shape::dots,
                         .tone = "ink",
                         .name = "recommended",
                         .width_px = 9,
                         .x = {study.amplitude_at_A(study.recommended)},
                         .y = {study.frequency_at_Hz(study.recommended)}});
  CaptionedFigure out{{.description = title + " over amplitude and frequency of the dither",
                       .x_title = "Amplitude of the coil current",
                       .x_quantity = units::Kind::current,
                       .x_lowest = -0.5 * across_A,
                       .x_highest = study.amplitude_A.back() + 0.5 * across_A},
                      caption,
                      heat.legend(title + ", % FS")};
  out.figure.panels.push_back(std::move(panel));
  return out;
}

/// Band, motion and ripple over the amplitude at some frequencies.
CaptionedFigure curves(const DitherStudy& study, double full_scale_m3_per_s) {
  CaptionedFigure out{{.description = "Band, motion and flow ripple over the amplitude of the dither",
                       .x_title = "Amplitude of the coil current",
                       .x_quantity = units::Kind::current,
                       .x_lowest = 0.0,
                       .x_highest = study.amplitude_A.back()}};
  Panel band{.title = "Half-width of the band [% FS]", .height_px = 190, .lowest = 0.0};
  Panel motion{.title = "Motion [µm]", .height_px = 150, .lowest = 0.0};
  Panel ripple{.title = "Flow ripple [% FS]", .height_px = 170, .lowest = 0.0};
  const double limit = 100 * study.question.ripple_limit_share;
  ripple.highest = 4 * limit;
  const std::vector<std::size_t> shown = shown_frequencies(study);
  double motion_at_limit_um = 0;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    Mark mark{.ramp = ramp(k, shown.size()), .x = study.amplitude_A};
    Mark of_motion = mark, of_ripple = mark;
    mark.name = frequency_text(study.frequency_Hz[shown[k]]);
    for (std::size_t a = 0; a < study.amplitude_A.size(); ++a) {
      const DitherSetting& each = study.settings[study.place(a, shown[k])];
      mark.y.push_back(100 * each.mean_band_m3_per_s / full_scale_m3_per_s);
      of_motion.y.push_back(1e6 * each.largest_motion_m);
      of_ripple.y.push_back(100 * each.largest_ripple_m3_per_s / full_scale_m3_per_s);
      if (of_ripple.y.back() < 4 * limit) motion_at_limit_um = std::max(motion_at_limit_um, of_motion.y.back());
    }
    band.marks.push_back(std::move(mark));
    motion.marks.push_back(std::move(of_motion));
    ripple.marks.push_back(std::move(of_ripple));
  }
  if (motion_at_limit_um > 0) motion.highest = 1.05 * motion_at_limit_um;
  ripple.marks.push_back({.shape = Shape::dashed,
                          .tone = "soft",
                          .name = "limit",
                          .x = {0, study.amplitude_A.back()},
                          .y = {limit, limit}});
  out.figure.panels = {std::move(band), std::move(motion), std::move(ripple)};
  out.caption =
      "Band: mean over the working points. Tremble and ripple: the largest of the points, half of peak to peak; cut "
      "off at four times the ripple's limit.";
  return out;
}

HtmlTable points_table(const DitherStudy& study, double full_scale_m3_per_s) {
  using units::Kind;
  HtmlTable table({{"Position", Set::number, Kind::length},
                   {"Difference", Set::number, Kind::pressure},
                   {"Flow rate", Set::number, Kind::flow},
                   {"Current", Set::number, Kind::current},
                   {"Sliding", Set::number, Kind::force},
                   {"Sticking", Set::number, Kind::force},
                   {"Half swing", Set::number, Kind::force},
                   {"Band without [% FS]"},
                   {"Band [% FS]"},
                   {"Motion [µm]"},
                   {"Ripple [% FS]"},
                   {"Freed", Set::text}});
  for (std::size_t p = 0; p < study.points.size(); ++p) {
    const DitherPoint& point = study.points[p];
    const DitherEffect& effect = study.effects[p][study.recommended];
    const auto percent = [&](double flow) { return fixed(100 * flow / full_scale_m3_per_s, 2); };
    table.row({fixed(units::length(point.point.position_m), 2),
               fixed(units::pressure(point.point.pressure_difference_Pa), 0),
               fixed(units::flow(point.flow_m3_per_s), 1), fixed(units::current(point.current_A), 2),
               fixed(units::force(point.sliding_N), 2), fixed(units::force(point.sticking_N), 2),
               fixed(units::force(effect.half_swing_N), 2), percent(study.effects[p].front().band_m3_per_s),
               percent(effect.band_m3_per_s), fixed(1e6 * effect.motion_m, 2), percent(effect.flow_ripple_m3_per_s),
               effect.frees ? "yes" : "no"});
  }
  return table;
}

}  // namespace

DitherVerdict dither_verdict(const model::Model& model, const DitherStudy& study) {
  const double full_scale = model.valve.rated_flow_m3_per_s;
  const auto percent = [&](double flow) { return fixed(100 * flow / full_scale, 2); };
  const std::string limit = three_digits(100 * study.question.ripple_limit_share);
  const DitherSetting& without = study.settings.front();
  const DitherSetting& best = study.settings[study.recommended];
  const double amplitude_A = study.amplitude_at_A(study.recommended);
  const std::string shape = study.question.shape == analysis::DitherShape::sine ? "sine" : "square";
  DitherVerdict out;
  if (amplitude_A == 0) {
    out.sentence = fmt::format(
        "No dither: none of the amplitudes and frequencies narrows the band worth speaking of with a flow ripple of no "
        "more than {} % FS.",
        limit);
  } else {
    out.sentence =
        phrase("Dither at {} with {} of coil current ({} % of the largest, {}, half of peak to peak).",
               frequency_text(study.frequency_at_Hz(study.recommended)), fixed(units::current(amplitude_A), 3),
               fixed(100 * amplitude_A / model.observer->parameters.largest_current_A, 1), shape);
  }
  out.remarks.push_back(
      phrase("The band at rest is then {} % FS ({}) to either side, {} % FS without dither: means over {} working "
             "points.",
             percent(best.mean_band_m3_per_s), fixed(units::flow(best.mean_band_m3_per_s), 2),
             percent(without.mean_band_m3_per_s), study.points.size()));
  std::size_t freed = 0;
  for (const auto& effects : study.effects) freed += effects[study.recommended].frees ? 1 : 0;
  out.remarks.push_back(
      phrase("The spool moves by up to {} µm, the flow by up to {} % FS ({}); the limit is {} % FS. Dither "
             "overcomes stiction both ways in each period at {} of {} points.",
             fixed(1e6 * best.largest_motion_m, 2), percent(best.largest_ripple_m3_per_s),
             three_digits(units::flow(best.largest_ripple_m3_per_s)), limit, freed, study.points.size()));
  out.remarks.emplace_back(
      "The amplitude is that of the measured coil current; the current control leaves out a part of what it is asked "
      "for, and the position control adds to it where the spool moves. Begin with less, and measure the ripple.");
  if (amplitude_A > 0) {
    out.remarks.push_back(
        phrase("The prediction keeps the limit up to {} times that amplitude: a reserve for the position control, "
               "which is not modelled and amplifies fast motion.",
               fixed(1 + analysis::amplitude_reserve(study.frequency_at_Hz(study.recommended)), 2)));
  }
  return out;
}

void write_dither_report(std::ostream& out, const model::Model& model, const DitherStudy& study,
                         const ReaderUnits& units) {
  const double full_scale = model.valve.rated_flow_m3_per_s;
  HtmlPage page("spoolflow dither report",
                "How to dither " + model.valve.name + ", f" + std::string(flow_name(model)).substr(1), origin_of(model),
                units);
  const DitherVerdict verdict = dither_verdict(model, study);
  page.verdict(verdict.sentence);
  page.remarks(verdict.remarks);
  page.section("Over amplitude and frequency");
  page.paragraph(
      "The band at rest is what friction and the maps leave open of the flow force. Dither takes half the swing of the "
      "magnetic force off friction's limits: the swing is that of the model's solenoid, with eddy currents and "
      "hysteresis, driven with this current about the one that holds the spool.");
  page.pair({setting_map(study, band_heat, "Half-width of the band",
                         "Half-width of the band at rest, mean over the working points.",
                         [&](const DitherSetting& each) { return 100 * each.mean_band_m3_per_s / full_scale; }),
             setting_map(study, ripple_heat, "Flow ripple",
                         "Half of peak to peak of the flow that the spool's motion makes, the largest of the points.",
                         [&](const DitherSetting& each) { return 100 * each.largest_ripple_m3_per_s / full_scale; })});
  page.figure(curves(study, full_scale));
  page.section("At the recommended setting");
  page.table(points_table(study, full_scale));
  page.note(fmt::format(
      "Current holds the spool; sliding and sticking are the limits of friction of the model in operation, the half "
      "swing is that of the magnetic force. The sticking limit is that after a rest of {} s. Up to friction the "
      "contacts give way elastically; beyond, the moving mass ({} kg) follows the force on springs and contacts, with "
      "friction that falls to {} of the bench's at speed (assumed). Left out: what the position control adds to the "
      "current where the spool moves, and changes of the pressure difference that the motion itself makes.",
      fixed(analysis::stated_rest_s, 0), three_digits(model.observer->parameters.moving_mass_kg),
      fixed(analysis::moving_friction_share, 1)));
  show_inputs(page, model, {});
  out << page.str();
}

}  // namespace spoolflow::report
