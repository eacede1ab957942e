#pragma once
/// An estimate as a table in the units of the trade: what ESTIMATE.csv and its like hold (docs/formats/estimate.md).
#include <span>
#include <string>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/written_tables/table_writer.hpp"
#include "spoolflow/sensor/basis/sample.hpp"

namespace spoolflow::apps {

/// Columns, units and flags, without notes.
[[nodiscard]] recording::TableHead estimate_table();
/// With notes of what wrote it (`tool`, with its version), of which valve, by which estimator.
[[nodiscard]] recording::TableHead estimate_table(const model::Model& model, estimation::Estimator estimator,
                                                  const std::string& tool);

/// The rows of these samples in `rows`, whose memory is used again. Both of one length.
void put_estimates(recording::TableRows& rows, std::span<const double> time_s,
                   std::span<const sensor::Estimate<double>> estimates);

}  // namespace spoolflow::apps
