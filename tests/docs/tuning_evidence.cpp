#include "tests/docs/tuning_evidence.hpp"

#include <fstream>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

namespace spoolflow::docs {
namespace {

constexpr std::size_t columns = 9;

/// At commas, the last column with its commas.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t begin = 0;
  for (std::size_t end = 0; cells.size() + 1 < columns && end != std::string::npos; begin = end + 1) {
    end = line.find(',', begin);
    if (end == std::string::npos) return cells;
    cells.push_back(line.substr(begin, end - begin));
  }
  cells.push_back(line.substr(begin));
  return cells;
}

std::string text_of(const std::vector<std::string>& cells) {
  if (cells[1].empty()) return cells[8];
  return fmt::format("{}: p95 {}, {}, {} % FS, band {}, {}, {} %", cells[1], cells[2], cells[3], cells[4], cells[5],
                     cells[6], cells[7]);
}

}  // namespace

std::map<std::string, std::string> read_tuning_evidence(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot be read", file.string()));
  std::map<std::string, std::string> out;
  std::string line;
  std::getline(in, line);  // the header
  for (int number = 2; std::getline(in, line); ++number) {
    const std::vector<std::string> cells = cells_of(line);
    const std::string where = fmt::format("{}:{}", file.string(), number);
    if (cells.size() != columns) throw std::runtime_error(fmt::format("{}: nine columns are wanted", where));
    const std::string text = text_of(cells);
    if (text.empty()) throw std::runtime_error(fmt::format("{}: neither a run nor a note", where));
    if (!out.emplace(cells[0], text).second) throw std::runtime_error(fmt::format("{}: {} again", where, cells[0]));
  }
  return out;
}

}  // namespace spoolflow::docs
