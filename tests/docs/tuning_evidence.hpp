#pragma once
/// spoolflow/model/tuning_evidence.csv: what runs show of each number of the sensor.
#include <filesystem>
#include <map>
#include <string>

namespace spoolflow::docs {

/// What each number's row says, as the page of parameters has it: "RUN: p95 a, b, c % FS, band d, e, f %", where the
/// number is halved, as it is, and doubled; or the row's note. Throws std::runtime_error, naming the line, where a row
/// has not its nine columns, names a number again, or says nothing.
[[nodiscard]] std::map<std::string, std::string> read_tuning_evidence(const std::filesystem::path& file);

}  // namespace spoolflow::docs
