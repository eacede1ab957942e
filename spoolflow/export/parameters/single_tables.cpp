#include "spoolflow/export/parameters/single_tables.hpp"

#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "spoolflow/export/number_groups.hpp"
#include "spoolflow/model/describe_observer.hpp"
#include "spoolflow/model/limit_check.hpp"

namespace spoolflow::exports {

std::unique_ptr<sensor::CondensedTables<float>> single_tables(const model::Condensed& condensed) {
  const auto tables = std::make_unique<sensor::CondensedTables<double>>();
  sensor::lay_out(condensed.parameters, *tables);
  return std::make_unique<sensor::CondensedTables<float>>(single_precision(*tables));
}

std::unique_ptr<sensor::ObserverParameters<float>> single_tables(const model::Observer& observer,
                                                                 const std::string& path) {
  auto single = std::make_unique<sensor::ObserverParameters<float>>(single_precision(observer.parameters));
  const auto found =
      model::violation(*single, [](auto& parameters, auto& visitor) { model::describe_observer(parameters, visitor); });
  if (found) {
    throw std::invalid_argument(
        fmt::format("in single precision the model's {}{}: {}; calibrate again and look at the report for what went "
                    "astray",
                    path, found->path, found->problem));
  }
  return single;
}

std::string sha256_of_model(const model::Model& model) {
  std::ostringstream out;
  model::write_model(out, model);
  return model::sha256_of_text(out.str());
}

}  // namespace spoolflow::exports
