#pragma once
/// What `estimate` writes of a recording, and says of how it was read.
#include <span>
#include <string>
#include <vector>

#include "spoolflow/estimation/status_text.hpp"
#include "spoolflow/recording/files/csv_writer.hpp"
#include "spoolflow/recording/reader.hpp"
#include "spoolflow/sensor/sample.hpp"

namespace spoolflow::apps {

void write_estimate_header(recording::CsvWriter& out);
/// One row a sample; both spans are equally long.
void write_estimate_rows(recording::CsvWriter& out, std::span<const double> time_s,
                         std::span<const sensor::Estimate<double>> estimates, estimation::StatusText& status_text);

/// What was met while reading, a line each; empty where all was well.
[[nodiscard]] std::vector<std::string> notes_text(const recording::ReadNotes& notes, const std::string& file);

}  // namespace spoolflow::apps
