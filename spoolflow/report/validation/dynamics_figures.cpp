#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "spoolflow/report/figures/figure.hpp"
#include "spoolflow/report/text/number_text.hpp"
#include "spoolflow/report/validation/validation_figures.hpp"

namespace spoolflow::report {
namespace {

std::string step_text(const validation::StepAnswer& answer, std::size_t steps) {
  if (answer.followed == 0) return fmt::format(" The {} follows none of them.", sensor_name(answer.estimator));
  std::string out =
      fmt::format(" {}: {} ms {} the meter, {} ms from 10 to 90 %, {} % overshoot", estimation::name(answer.estimator),
                  fixed(1e3 * std::abs(answer.delay_s), 0), answer.delay_s < 0 ? "before" : "after",
                  fixed(1e3 * answer.rise_s, 0), fixed(100 * answer.overshoot, 0));
  if (answer.followed < steps) out += fmt::format(" ({} of them followed)", answer.followed);
  return out + ".";
}

CaptionedFigure step_figure(const validation::StepResponse& response, const std::string& run) {
  const std::vector<double> time_ms = scaled(response.time_s, 1e3);
  Panel panel{.title = "Share of the step", .height_px = 220};
  panel.marks.push_back(
      {Shape::line, "ink", {}, "measured", "", 1.9, time_ms, scaled(response.reference_course, 1), {}});
  std::string caption =
      fmt::format("Response to {} step{} of the flow, mean of all; medians: the meter takes {} ms from 10 to 90 %.",
                  response.steps, response.steps == 1 ? "" : "s", fixed(1e3 * response.reference_rise_s, 0));
  for (const validation::StepAnswer& answer : response.answers) {
    caption += step_text(answer, response.steps);
    if (answer.followed == 0) continue;
    const std::string name(estimation::name(answer.estimator));
    panel.marks.push_back({.tone = name, .name = name, .width_px = 1.4, .x = time_ms, .y = scaled(answer.course, 1)});
  }
  return {{.description = "Step response, run " + run,
           .x_title = "Time from the middle of the measured step [ms]",
           .panels = {std::move(panel)}},
          caption};
}

CaptionedFigure frequency_figure(const validation::RunResult& run) {
  Panel gain{.title = "Gain, estimated over true flow", .height_px = 130, .lowest = 0.0};
  Panel phase{.title = "Phase [\u00b0]", .height_px = 90};
  std::string caption = "Frequency response, as far as the run excites it (the meter's lag taken out).";
  for (const validation::EstimatorResult& result : run.results) {
    if (!result.frequency_response) continue;
    const std::string name(estimation::name(result.estimator));
    Mark gains{.tone = name, .name = name, .width_px = 1.6};
    Mark phases{.tone = name, .width_px = 1.6};
    for (const validation::FrequencyPoint& point : result.frequency_response->points) {
      gains.x.push_back(std::log10(point.frequency_Hz));
      gains.y.push_back(point.gain);
      phases.y.push_back(point.phase_rad * 180 / std::numbers::pi);
    }
    phases.x = gains.x;
    caption += result.frequency_response->corner_Hz
                   ? fmt::format(" {}: \u22123 dB at {} Hz.", name, three_digits(*result.frequency_response->corner_Hz))
                   : fmt::format(" {}: above \u22123 dB up to {} Hz, where the excitation ends.", name,
                                 three_digits(result.frequency_response->points.back().frequency_Hz));
    gain.marks.push_back(std::move(gains));
    phase.marks.push_back(std::move(phases));
  }
  CaptionedFigure out{{.description = "Frequency response, run " + run.name,
                       .x_title = "Frequency [Hz]",
                       .panels = {std::move(gain), std::move(phase)}},
                      caption};
  for (int decade = -3; decade <= 3; ++decade) {
    for (const int digit : {1, 2, 5}) {
      const double frequency_Hz = digit * std::pow(10, decade);
      out.figure.x_marks.push_back({std::log10(frequency_Hz), fmt::format("{:g}", frequency_Hz)});
    }
  }
  return out;
}

}  // namespace

std::vector<CaptionedFigure> dynamics_figures(const validation::RunResult& run) {
  std::vector<CaptionedFigure> out;
  if (run.step_response) out.push_back(step_figure(*run.step_response, run.name));
  for (const validation::EstimatorResult& result : run.results) {
    if (!result.frequency_response) continue;
    out.push_back(frequency_figure(run));
    break;
  }
  return out;
}

}  // namespace spoolflow::report
