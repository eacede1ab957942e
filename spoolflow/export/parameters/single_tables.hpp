#pragma once
/// A model's tables as the valve has them, in single precision.
#include <memory>
#include <string>

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

}  // namespace spoolflow::exports
