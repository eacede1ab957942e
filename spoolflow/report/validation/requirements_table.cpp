#include "spoolflow/report/validation/requirements_table.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "spoolflow/report/text/html_text.hpp"
#include "spoolflow/report/text/number_text.hpp"
#include "spoolflow/units/conversion.hpp"
#include "spoolflow/validation/judged_limits.hpp"

namespace spoolflow::report {
namespace {

using validation::JudgedLimit;

/// Of an estimator, whose name goes into the braces.
constexpr std::array figure_texts = [] {
  using enum validation::Figure;
  return std::to_array<validation::Named<validation::Figure>>({
      {p95, "95th percentile of the {}'s error"},
      {rms, "RMS of the {}'s error"},
      {largest, "largest error of the {}"},
      {bias, "size of the {}'s mean error"},
      {band_mean_width, "mean width of the {}'s 95 % band"},
      {band_coverage, "share of the samples inside the {}'s 95 % band"},
      {p95_of_reading, "95th percentile of the {}'s error, of reading"},
      {wrong_sign, "share of the samples whose flow has the other sign than the {}'s"},
      {fault_share, "share of the samples with a fault of the {}"},
  });
}();
constexpr std::array when_texts = [] {
  using enum validation::When;
  return std::to_array<validation::Named<validation::When>>({
      {always, ""},
      {moving, ", moving"},
      {rest, ", at rest"},
      {reversal, ", around reversal"},
      {p_to_b, ", flow P to B"},
      {p_to_a, ", flow P to A"},
  });
}();

std::string figure_text(const JudgedLimit& judged) {
  return fmt::format(fmt::runtime(name_of(figure_texts, judged.limit.figure)), estimation::name(judged.estimator));
}

std::string_view when_text(validation::When when) {
  return name_of(when_texts, when);
}

/// A flow that is written in a limit's unit.
units::Quantity limit_flow(double value_L_min) {
  return units::flow(units::m3_per_s_from_L_per_min(value_L_min));
}

Text bounds_text(const validation::Limit& limit) {
  if (limit.unit == validation::LimitUnit::litre_per_minute) {
    if (limit.at_least && limit.at_most)
      return phrase("{} to {}", bare(general(limit_flow(*limit.at_least))), general(limit_flow(*limit.at_most)));
    if (limit.at_least) return phrase("at least {}", general(limit_flow(*limit.at_least)));
    return phrase("at most {}", general(limit_flow(*limit.at_most)));
  }
  const std::string_view unit = name_of(validation::limit_unit_names, limit.unit);
  if (limit.at_least && limit.at_most) return fmt::format("{:g} to {:g} {}", *limit.at_least, *limit.at_most, unit);
  if (limit.at_least) return fmt::format("at least {:g} {}", *limit.at_least, unit);
  return fmt::format("at most {:g} {}", *limit.at_most, unit);
}

}  // namespace

std::string requirements_sentence(const validation::Validation& validation) {
  const auto all = validation.limits.size();
  const auto met =
      static_cast<std::size_t>(std::ranges::count_if(validation.limits, [](auto& each) { return each.met; }));
  if (met == all) {
    return all == 1 ? fmt::format("The limit of {} is met.", validation.requirements_file)
                    : fmt::format("All {} limits of {} are met.", all, validation.requirements_file);
  }
  return fmt::format("{} of {} limits of {} {} not met.", all - met, all, validation.requirements_file,
                     all - met == 1 ? "is" : "are");
}

Text limit_text(const JudgedLimit& judged) {
  return phrase("{}{}: {}", figure_text(judged), when_text(judged.limit.when), bounds_text(judged.limit));
}

Text value_text(const JudgedLimit& judged) {
  if (judged.calibrated_with) return "no independent test: the calibration read it; give a run that it did not read";
  if (!judged.value) return "nothing: no reference flow, or no such samples";
  if (judged.limit.unit == validation::LimitUnit::litre_per_minute) return fixed(limit_flow(*judged.value), 2);
  return fixed(*judged.value, 2) + " " + std::string(name_of(validation::limit_unit_names, judged.limit.unit));
}

std::vector<JudgedLimit> shown_limits(const validation::Validation& validation, double full_scale_m3_per_s) {
  if (!validation.limits.empty()) return validation.limits;
  if (validation.pooled.empty() || !validation.pooled.back().metrics) return {};
  return validation::judge(validation::default_requirements(), validation, full_scale_m3_per_s);
}

void show_requirements(HtmlPage& page, const validation::Validation& validation,
                       const std::vector<JudgedLimit>& limits) {
  if (limits.empty()) return;
  const bool asked = !validation.limits.empty();
  const bool judged =
      asked || std::ranges::all_of(limits, [](const JudgedLimit& each) { return each.value.has_value(); });
  const char* said = !judged ? "not judged" : std::ranges::all_of(limits, &JudgedLimit::met) ? "pass" : "fail";
  page.html(fmt::format("<p class=\"requirements\"><b class=\"badge {}\">{}</b> ", judged ? said : "open", said));
  if (asked) {
    page.html(html_text(requirements_sentence(validation)));
  } else {
    page.html("By default limits: ");
    for (const JudgedLimit& each : limits) {
      page.html(
          html_text(fmt::format("{}{}", &each == &limits.front() ? "" : "; ", limit_text(each).in(page.units()))));
    }
    page.html(". Yours: <code>--requirements</code>.");
  }
  page.html("</p>\n");
}

void show_limits(HtmlPage& page, const std::vector<JudgedLimit>& limits) {
  if (limits.empty()) return;
  HtmlTable table({{"", Set::text}, {"What was asked", Set::sentence}, {"Run", Set::text}, {"limit"}, {"figure"}});
  for (const JudgedLimit& judged : limits) {
    table.row({fmt::format("<b class=\"badge {}\">{}</b>", judged.met ? "pass" : (judged.value ? "fail" : "open"),
                           judged.met ? "pass" : (judged.value ? "fail" : "not judged")),
               html_text(fmt::format("{}{}", figure_text(judged), when_text(judged.limit.when))), html_text(judged.run),
               bounds_text(judged.limit), judged.value ? value_text(judged) : "\u2013"});
  }
  page.table(table);
}

}  // namespace spoolflow::report
