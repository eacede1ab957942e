/// documentation/index.html of an FMU.
#include <fmt/format.h>

#include "spoolflow/export/fmu/number_text.hpp"
#include "spoolflow/export/fmu_content.hpp"
#include "spoolflow/export/fmu_words.hpp"
#include "spoolflow/export/xml_text.hpp"

namespace spoolflow::exports {
namespace {

using fmu::number_text;

std::string row(const fmu::Variable& variable) {
  const bool has_start = variable.causality == fmu::Causality::parameter || variable.causality == fmu::Causality::input;
  const bool has_range = variable.lowest == variable.lowest && variable.type != fmu::Type::boolean;
  std::string unit = xml_text(variable.unit);
  if (!variable.display_unit.empty()) unit += " (" + xml_text(variable.display_unit) + ")";
  const char* kind = variable.causality == fmu::Causality::parameter ? word(variable.variability) : "";
  return fmt::format("<tr><td>{}</td><td>{} {}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                     xml_text(variable.name), kind, word(variable.causality), unit,
                     has_start ? number_text(variable.start) : "",
                     has_range ? number_text(variable.lowest) + " to " + number_text(variable.highest) : "",
                     xml_text(variable.description));
}

}  // namespace

std::string fmu_documentation(const FmuContent& content) {
  std::string rows;
  for (const fmu::Variable& variable : content.variables) rows += row(variable);
  return fmt::format(R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>{0}</title>
<style>
body {{ font-family: sans-serif; max-width: 60em; margin: 2em auto; line-height: 1.4 }}
table {{ border-collapse: collapse }}
td, th {{ border: 1px solid #aaa; padding: 0.2em 0.5em; text-align: left; vertical-align: top }}
</style>
</head>
<body>
<h1>{0}</h1>
<p>{1}</p>
{2}<h2>Time</h2>
<p>Samples are taken at fixed instants, start time + n times the sample step, counted by an integer, whatever the communication
step. A communication step from t to t + h takes every sample in [t, t + h) with the inputs that were set at t; an instant
that two steps share belongs to the later one. Outputs after the step are those of its last sample. So with a communication step
equal to the sample step, the output at t + h answers the input that was set at t: one step of delay, as for every
co-simulation FMU. A step of zero or backwards is refused (discard) with a message, and nothing changes.</p>
<h2>Variables</h2>
<table>
<tr><th>name</th><th>kind</th><th>unit (display)</th><th>start</th><th>range</th><th>meaning</th></tr>
{3}</table>
<p>Made by spoolflow {4} on {5}. Apache License 2.0: see licenses/license.txt.</p>
</body>
</html>
)",
                     xml_text(content.model_name), xml_text(content.description), content.notes_html, rows,
                     content.tool_version, content.generation_time);
}

}  // namespace spoolflow::exports
