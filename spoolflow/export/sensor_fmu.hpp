#pragma once
#include <string>
#include <string_view>

#include "spoolflow/export/fmu_content.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::exports {

/// What the sensor's FMU of a model shows and holds, but its token.
[[nodiscard]] FmuContent sensor_fmu_content(const model::Model& model, std::string_view tool_version);
/// The sensor of a model as a co-simulation FMU, the bytes of its file: the observer where the model has one, the
/// condensed sensor otherwise. It answers as `estimate` does on the same samples.
[[nodiscard]] std::string sensor_fmu(const model::Model& model, FmiVersion version, std::string_view tool_version);

}  // namespace spoolflow::exports
