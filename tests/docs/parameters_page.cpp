/// Prints docs/formats/parameters.md: every number of the sensor as its description has it.
#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "spoolflow/model/describe_campaign.hpp"
#include "spoolflow/model/describe_condensed.hpp"
#include "spoolflow/model/describe_observer.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::docs {
namespace {

using model::Relation;

/// What a number must hold beside its range, after a semicolon; empty where nothing.
std::string in_words(const Relation& relation) {
  switch (relation.kind) {
    case Relation::Kind::none:
      return "";
    case Relation::Kind::rises:
      return "; rises";
    case Relation::Kind::rises_over_rows:
      return fmt::format("; rises from row to row, by {} of the largest entry at least", relation.least);
    case Relation::Kind::never_falls:
      return "; never falls along a row";
    case Relation::Kind::alike:
      return fmt::format("; neighbours differ by a factor of {} at most", relation.least);
    case Relation::Kind::not_above:
      return fmt::format("; not larger than `{}`", relation.other);
    case Relation::Kind::sum_not_negative:
      return fmt::format("; `{}` added, not below zero", relation.other);
  }
  return "";
}

std::string allowed(const model::Limits& limits) {
  return fmt::format("{:g}…{:g}", limits.lowest, limits.highest);
}

/// Writes a line of a table for each number: visitor of the descriptions.
class Lines {
 public:
  template <class Value>
  void number(const model::Parameter& about, const Value& /*value*/) {
    line(about.key, about.unit, allowed(about.limits), in_words(about.relation), about.meaning);
  }
  template <class Values>
  void list(const model::Parameter& about, const Values& values) {
    line(fmt::format("{}[{}]", about.key, values.size()), about.unit, allowed(about.limits), in_words(about.relation),
         about.meaning);
  }
  template <class Axis>
  void axis(const model::AxisParameter& about, const Axis& /*axis*/, int points) {
    line(fmt::format("{}[{}]", about.key, points), about.unit, allowed(about.limits), "; rises in equal steps",
         "axis of the volumes below");
  }
  template <class Curve>
  void curve(const model::TableParameter& about, const Curve& /*curve*/) {
    table(about, fmt::format("; over `{}`[{}]", about.columns.key, Curve::points));
  }
  template <class Map>
  void map(const model::TableParameter& about, const Map& /*map*/) {
    table(about, fmt::format("; over `{}`[{}] (rows) and `{}`[{}]", about.rows.key, Map::rows, about.columns.key,
                             Map::columns));
  }
  template <class Volume>
  void volume(const model::TableParameter& about, const Volume& /*volume*/) {
    table(about, "; over the three axes above");
  }
  void heading(const std::string& text) {
    out += "\n## " + text + "\n\n| key | unit | range | meaning |\n|---|---|---|---|\n";
  }

  std::string out;

 private:
  void table(const model::TableParameter& about, const std::string& over) {
    line(about.key, about.unit, allowed(about.limits), in_words(about.relation), about.meaning + over);
  }
  void line(const std::string& key, const std::string& unit, const std::string& range, const std::string& relation,
            const std::string& meaning) {
    out += fmt::format("| `{}` | {} | {} | {}{} |\n", key, unit, range, meaning, relation);
  }
};

std::string page() {
  Lines lines;
  lines.out =
      "# Parameters\n\nMade by `ci/parameters_page.sh` from the descriptions in "
      "`spoolflow/model/describe_observer.hpp` and its neighbours, which also read and write\nthe model file and "
      "refuse "
      "what lies outside of range or relation. The sensor's constants, the same for all valves, stand in\n"
      "`spoolflow/sensor` where they are used; what runs show of each number in "
      "`spoolflow/model/tuning_evidence.csv`\n(`bench/tuning_evidence.py --update`).\n";
  lines.heading("Valve");
  const model::Model model{};
  model::describe_valve(model.valve, lines);
  lines.heading("Fluid and instruments");
  model::describe_fluid(model.fluid, lines);
  model::describe_instruments(model.instruments, lines);
  lines.heading("Condensed sensor");
  model::describe_condensed(model.condensed.parameters, lines);
  lines.heading("Observer");
  const sensor::ObserverParameters<double> observer{};
  model::describe_observer(observer, lines);
  return lines.out;
}

}  // namespace
}  // namespace spoolflow::docs

int main() {
  std::fputs(spoolflow::docs::page().c_str(), stdout);
}
