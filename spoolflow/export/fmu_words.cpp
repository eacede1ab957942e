#include "spoolflow/export/fmu_words.hpp"

#include <fmt/format.h>

#include "spoolflow/export/fmu/number_text.hpp"

namespace spoolflow::exports {

using fmu::Causality;
using fmu::Variability;

const char* word(Causality causality) {
  switch (causality) {
    case Causality::independent:
      return "independent";
    case Causality::parameter:
      return "parameter";
    case Causality::input:
      return "input";
    case Causality::output:
      return "output";
  }
  return "local";
}

const char* word(Variability variability) {
  switch (variability) {
    case Variability::fixed:
      return "fixed";
    case Variability::tunable:
      return "tunable";
    case Variability::discrete:
      return "discrete";
    case Variability::continuous:
      return "continuous";
  }
  return "continuous";
}

std::string initial(const fmu::Variable& variable) {
  if (variable.causality == Causality::parameter) return " initial=\"exact\"";
  if (variable.causality == Causality::output) return " initial=\"calculated\"";
  return {};
}

std::string limits(const fmu::Variable& variable) {
  std::string out;
  const auto add = [&](const char* name, double value) {
    if (value == value) out += fmt::format(" {}=\"{}\"", name, fmu::number_text(value));
  };
  add("min", variable.lowest);
  add("max", variable.highest);
  if (variable.type == fmu::Type::real) add("nominal", variable.nominal);
  return out;
}

std::string log_categories() {
  return "    <Category name=\"logStatusDiscard\" description=\"a step was refused, nothing has changed\"/>\n"
         "    <Category name=\"logStatusError\" description=\"a call could not be followed\"/>\n"
         "    <Category name=\"logStatusFatal\" description=\"the instance cannot be used any more\"/>\n";
}

}  // namespace spoolflow::exports
