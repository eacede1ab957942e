#include "spoolflow/model/residual_of.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace spoolflow::model {

const Residual& residual_of(const Model& model, const std::vector<Residual>& residuals, std::string_view of) {
  const auto found =
      std::find_if(residuals.begin(), residuals.end(), [&](const Residual& each) { return each.of == of; });
  if (found == residuals.end()) {
    throw ModelError(
        fmt::format("the model of {} has no residual of its {}, so its uncertainty is unknown; calibrate it again "
                    "with this program",
                    model.valve.name, of));
  }
  return *found;
}

}  // namespace spoolflow::model
