#pragma once
/// A valve's parameters apart from code: the bytes of a flash page, as spoolflow/sensor/parameter_image lays them down.
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "spoolflow/model/model.hpp"

namespace spoolflow::exports {

/// The condensed sensor's, laid out for its step. Throws std::invalid_argument where a number does not fit.
[[nodiscard]] std::unique_ptr<sensor::CondensedTables<float>> single_tables(const model::Condensed& condensed);

/// The observer's. `path`: of it in the model file, for messages. Throws std::invalid_argument where a number does not
/// fit, or where what holds in double precision does not in the valve's: two thresholds may have become one.
[[nodiscard]] std::unique_ptr<sensor::ObserverParameters<float>> single_tables(const model::Observer& observer,
                                                                               const std::string& path);

/// Of the model file as spoolflow writes it, 64 hexadecimal digits.
[[nodiscard]] std::string sha256_of_model(const model::Model& model);

/// What the bytes hold beside the model, and which of its sensors they hold.
struct ImageContents {
  std::string_view tool_version;
  std::uint64_t created_s;  ///< since 1970 in UTC
  bool condensed = true;
  bool observer = true;  ///< where the model has one
};

/// The same model and contents give the same bytes. Throws std::invalid_argument where a number of the model does not
/// fit into single precision, or where nothing is left to be held.
[[nodiscard]] std::string parameter_image(const model::Model& model, const ImageContents& contents);

}  // namespace spoolflow::exports
