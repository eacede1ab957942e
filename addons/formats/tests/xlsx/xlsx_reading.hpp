#pragma once
/// What is read of workbooks that tests make.
#include <string>
#include <vector>

#include "addons/formats/tests/xlsx/xlsx_file.hpp"
#include "spoolflow/recording/open_table.hpp"
#include "tests/recording/column_of.hpp"
#include "tests/recording/refusal.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {

inline std::vector<double> xlsx_column(const std::string& bytes, const std::string& name) {
  return column_of("run.xlsx", bytes, name);
}

inline std::string xlsx_refused(const std::string& bytes, const std::string& name = "run.xlsx") {
  const TemporaryFile file(name, bytes);
  return refusal([&] {
    const auto table = open_sample_table(file.path()).table;
    std::vector<std::size_t> all;
    for (std::size_t k = 0; k < table->columns().size(); ++k) all.push_back(k);
    table->select(all);
    std::vector<double> values(64 * all.size());
    std::vector<double*> out;
    for (const std::size_t k : all) out.push_back(values.data() + 64 * k);
    (void)table->read(out, 64);
  });
}

inline std::vector<std::string> xlsx_names(const std::string& bytes) {
  const TemporaryFile file("run.xlsx", bytes);
  std::vector<std::string> out;
  const auto table = open_sample_table(file.path()).table;
  for (const FileColumn& each : table->columns()) out.push_back(each.name + "|" + each.unit);
  return out;
}

inline const std::string name_row = xlsx_row({"'time_s", "'current_A", "'position_mm"});

inline std::string xlsx_book(const std::string& rows) {
  return XlsxFile().sheet("Sheet1", rows).content();
}

}  // namespace spoolflow::recording
