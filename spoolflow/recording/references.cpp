#include "spoolflow/recording/references.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "spoolflow/recording/channels/byte_order_mark.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/decimal_number.hpp"
#include "spoolflow/recording/toml_input.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::array<std::string_view, 4> kind_names{"stroke", "pump", "meter", "closed"};
constexpr std::array<std::string_view, 4> end_names{"marks", "pressure", "switch", "stalled"};
constexpr std::array<std::string_view, 2> direction_names{"b", "a"};
constexpr double rad_per_s_per_rpm = std::numbers::pi / 30;
constexpr double percent = 0.01, m2_per_cm2 = 1e-4, m3_per_cm3 = 1e-6;

/// The columns of a file of marks in their order, the last for a pump.
constexpr std::array<std::string_view, 3> mark_columns{"begin_s", "end_s", "speed_rpm"};

constexpr NumberRange any_speed{1, 1e5, "give the pump's speed in turns a minute"};

/// Cells of a line between commas, semicolons, tabs or blanks, without quotes. Beside semicolons or tabs a comma is a
/// decimal sign.
std::vector<std::string> cells_of_marks(std::string line) {
  constexpr const char* between = ",; \t\r\"";
  if (line.find_first_of(";\t") != std::string::npos) std::ranges::replace(line, ',', '.');
  std::vector<std::string> out;
  for (std::size_t at = line.find_first_not_of(between); at != std::string::npos;) {
    const std::size_t after = line.find_first_of(between, at);
    out.push_back(line.substr(at, after - at));
    at = line.find_first_not_of(between, after);
  }
  return out;
}

/// How many of mark_columns the row of names has. Throws RecordingError with the line.
std::size_t count_of_columns(const std::string& line, const std::string& place) {
  const std::vector<std::string> names = cells_of_marks(line);
  if (names.size() >= 2 && names.size() <= mark_columns.size() &&
      std::equal(names.begin(), names.end(), mark_columns.begin()))
    return names.size();
  throw RecordingError(
      fmt::format("{}: \"{}\" names no columns of marks; write begin_s,end_s above the rows, of a pump also "
                  "begin_s,end_s,speed_rpm, and times in seconds of the recording",
                  place, line.substr(0, 60)));
}

/// One row. Throws RecordingError with the line.
TimeMark mark_of(const std::string& line, const std::string& place, std::size_t columns) {
  std::vector<double> row;
  for (const std::string& cell : cells_of_marks(line)) {
    if (read_number(cell, '.', row.emplace_back()) != Digits::number) {
      throw RecordingError(fmt::format("{}: \"{}\" is no row of marks; a row is begin_s, end_s and of a pump speed_rpm",
                                       place, line.substr(0, 60)));
    }
  }
  if (row.size() < 2 || row.size() > columns) {
    throw RecordingError(
        fmt::format("{}: has {} numbers for the columns {}; write one number a column, and a decimal comma with "
                    "semicolons between the columns",
                    place, row.size(), fmt::join(std::span(mark_columns).first(columns), ", ")));
  }
  if (row.size() == 2) return {row[0], row[1], std::numeric_limits<double>::quiet_NaN()};
  if (!(row[2] >= any_speed.least && row[2] <= any_speed.most)) {
    throw RecordingError(fmt::format("{}: speed_rpm = {} is not between {} and {}; {}, or leave the row out", place,
                                     row[2], any_speed.least, any_speed.most, any_speed.otherwise));
  }
  return {row[0], row[1], row[2] * rad_per_s_per_rpm};
}

/// A file of rows `begin_s, end_s[, speed_rpm]` under a row that names them.
std::vector<TimeMark> marks_of(const TomlTable& table, const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in || std::filesystem::is_directory(file)) {
    throw RecordingError(fmt::format("{}: the file of marks {} cannot be read; correct marks = \"{}\" or put it there",
                                     table.place("marks"), file.string(), table.text("marks")));
  }
  std::vector<TimeMark> out;
  std::string line;
  std::size_t number = 0, columns = 0;
  while (std::getline(in, line)) {
    const std::string place = fmt::format("{}, line {}", file.string(), ++number);
    if (number == 1) line = std::string(without_byte_order_mark(line));
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.starts_with('#')) continue;
    if (columns == 0) {
      columns = count_of_columns(line, place);
      continue;
    }
    const TimeMark mark = mark_of(line, place, columns);
    if (!(mark.end_s > mark.begin_s) || (!out.empty() && mark.begin_s < out.back().end_s)) {
      throw RecordingError(
          fmt::format("{}: {} s to {} s is no interval after the one before it; order the rows by "
                      "time and let them not overlap",
                      place, mark.begin_s, mark.end_s));
    }
    out.push_back(mark);
  }
  if (out.empty()) throw RecordingError(fmt::format("{}: has no rows of marks begin_s, end_s", file.string()));
  return out;
}

void read_marks(const TomlTable& table, Reference& out) {
  out.marks_file = table.file.parent_path() / table.text("marks");
  out.marks = marks_of(table, out.marks_file);
}

constexpr NumberRange any_percent{0.05, 20, "give the half width at 95 % in percent"};
constexpr NumberRange any_leakage{0, 20, "give the half width at 95 % in L/min"};

/// In the unit of the key, or `otherwise` where it is not given.
double within(const TomlTable& table, std::string_view key, const NumberRange& range, double otherwise) {
  return table.optional_within(key, range).value_or(otherwise);
}

void read_stroke(const TomlTable& table, Reference& out) {
  table.allow_only({"kind", "name", "recording", "direction", "ends", "marks", "area_cm2", "length_mm",
                    "area_uncertainty_percent", "length_uncertainty_mm", "seal_leakage_L_min", "oil_column_cm3",
                    "highest_pressure_bar"});
  out.ends = static_cast<EndsSeen>(table.choice("ends", end_names));
  if (out.ends == EndsSeen::marks) read_marks(table, out);
  if (out.ends != EndsSeen::marks && table.optional_text("marks")) {
    throw RecordingError(fmt::format("{}: marks stands with ends = \"{}\"; leave marks out, or write ends = \"marks\"",
                                     table.place("marks"), end_names[static_cast<std::size_t>(out.ends)]));
  }
  out.area_m2 = table.within("area_cm2", {0.1, 1e4, "give the area that the oil fills in cm2"}) * m2_per_cm2;
  out.length_m = units::m_from_mm(table.within("length_mm", {5, 2e4, "give the way from end to end in mm"}));
  out.share_uncertainty = within(table, "area_uncertainty_percent", any_percent, 0.5) * percent;
  out.length_uncertainty_m =
      units::m_from_mm(within(table, "length_uncertainty_mm",
                              {0, 0.2 * units::mm_from_m(out.length_m), "give the half width at 95 % in mm"}, 1));
  out.leakage_uncertainty_m3_per_s =
      units::m3_per_s_from_L_per_min(within(table, "seal_leakage_L_min", any_leakage, 0.1));
  constexpr double bulk_modulus_Pa = 1.4e9;  // oil in hoses, with its air
  const double column_m3 =
      within(table, "oil_column_cm3", {0, 1e6, "give the oil between valve and piston in cm3"}, 0) * m3_per_cm3;
  const double highest_Pa = units::Pa_from_bar(
      within(table, "highest_pressure_bar", {1, 1000, "give the highest pressure there in bar"}, 200));
  out.compression_m3 = column_m3 * highest_Pa / bulk_modulus_Pa;
}

void read_pump(const TomlTable& table, Reference& out) {
  table.allow_only({"kind", "name", "recording", "direction", "marks", "displacement_cm3", "speed_rpm", "leakage_L_min",
                    "displacement_uncertainty_percent", "leakage_uncertainty_L_min"});
  read_marks(table, out);
  out.displacement_m3_per_rad =
      table.within("displacement_cm3", {0.1, 1e4, "give what the pump displaces a turn in cm3"}) * m3_per_cm3 /
      (2 * std::numbers::pi);
  const NumberRange speeds{any_speed.least, any_speed.most,
                           "give the pump's speed in turns a minute, or a third column speed_rpm among the marks"};
  const bool each = std::ranges::all_of(out.marks, [](const TimeMark& mark) { return mark.speed_rad_per_s > 0; });
  out.speed_rad_per_s =
      (each ? within(table, "speed_rpm", speeds, 1) : table.within("speed_rpm", speeds)) * rad_per_s_per_rpm;
  out.leakage_m3_per_s = units::m3_per_s_from_L_per_min(
      within(table, "leakage_L_min", {0, 1e3, "give what the pump loses at work in L/min"}, 0));
  out.share_uncertainty = within(table, "displacement_uncertainty_percent", any_percent, 1) * percent;
  out.leakage_uncertainty_m3_per_s =
      units::m3_per_s_from_L_per_min(within(table, "leakage_uncertainty_L_min", any_leakage, 0.3));
}

void read_meter(const TomlTable& table, Reference& out) {
  table.allow_only(
      {"kind", "name", "recording", "direction", "uncertainty_percent", "zero_uncertainty_L_min", "interval_s"});
  out.share_uncertainty = within(table, "uncertainty_percent", any_percent, 1) * percent;
  out.leakage_uncertainty_m3_per_s =
      units::m3_per_s_from_L_per_min(within(table, "zero_uncertainty_L_min", any_leakage, 0.1));
  out.interval_s = within(table, "interval_s", {0.5, 3600, "give the time in s over which the meter is averaged"}, 2);
}

Reference reference_of(const TomlTable& table, std::size_t number) {
  Reference out;
  out.kind = static_cast<ReferenceKind>(table.choice("kind", kind_names));
  out.place = place_of(table.table, table.file);
  out.name = table.optional_text("name").value_or(fmt::format("{} {}", name(out.kind), number));
  out.recording = table.optional_text("recording").value_or("");
  if (const auto direction = table.optional_choice("direction", direction_names);
      direction && out.kind != ReferenceKind::closed)
    out.direction = direction_names[*direction];
  if (out.kind == ReferenceKind::stroke) read_stroke(table, out);
  if (out.kind == ReferenceKind::pump) read_pump(table, out);
  if (out.kind == ReferenceKind::meter) read_meter(table, out);
  if (out.kind == ReferenceKind::closed) table.allow_only({"kind", "name", "recording"});
  return out;
}

}  // namespace

std::string_view name(ReferenceKind kind) {
  return kind_names[static_cast<std::size_t>(kind)];
}

std::vector<Reference> read_references(const std::filesystem::path& file) {
  const toml::table read = read_toml(file);
  const TomlTable document{read, file, "the references"};
  document.allow_only({"reference"});
  std::vector<Reference> out;
  for (const TomlTable& entry : document.tables("reference",
                                                "names no references; add tables [[reference]] with kind = \"stroke\", "
                                                "\"pump\", \"meter\" or \"closed\""))
    out.push_back(reference_of(entry, out.size() + 1));
  return out;
}

}  // namespace spoolflow::recording
