#include "addons/live/valve/raw_trace.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "spoolflow/recording/files/csv_writer.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::live {
namespace {

constexpr std::size_t most_samples = 1'000'000;
constexpr std::size_t piece_samples = 1024;
/// Of samples that come slowly: their times since its begin need 32 bits.
constexpr double longest_piece_s = 400;

/// Of a recording's column; the order is that of the numbers.
struct Column {
  const char* name;        ///< of a valve of one direction
  const char* whole_name;  ///< of a whole valve whose coils both have their instruments
  double factor, offset;   ///< from SI to its unit
  int decimals;
};
constexpr double bar = 1 / units::pascal_per_bar;
constexpr std::array<Column, 10> columns{{{"current_A", "current_b_A", 1, 0, 6},
                                          {"voltage_V", "voltage_b_V", 1, 0, 5},
                                          {"position_mm", "position_mm", 1e3, 0, 6},
                                          {"oil_temperature_C", "oil_temperature_C", 1, -273.15, 3},
                                          {"current_a_A", "current_a_A", 1, 0, 6},
                                          {"voltage_a_V", "voltage_a_V", 1, 0, 5},
                                          {"pressure_p_bar", "pressure_p_bar", bar, 0, 4},
                                          {"pressure_a_bar", "pressure_a_bar", bar, 0, 4},
                                          {"pressure_b_bar", "pressure_b_bar", bar, 0, 4},
                                          {"pressure_t_bar", "pressure_t_bar", bar, 0, 4}}};

/// What is no finite number was not measured.
float kept(double value) {
  return std::isfinite(value) ? static_cast<float>(value) : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

/// Of those that became too old one is filled again.
void RawTrace::begin_piece(double time_s) {
  Piece next;
  while (!pieces_.empty() && (count_ + piece_samples > most_samples || pieces_.front().last_s() < time_s - length_s_)) {
    next = std::move(pieces_.front());
    pieces_.pop_front();
    count_ -= next.since_begin.size();
    next.since_begin.clear();
    next.numbers.clear();
  }
  next.since_begin.reserve(piece_samples);
  next.numbers.reserve(piece_samples * width_);
  next.begin_s = time_s;
  pieces_.push_back(std::move(next));
}

void RawTrace::add(const estimation::TimedSample& sample) {
  if (length_s_ <= 0 || !std::isfinite(sample.time_s)) return;
  if (!pieces_.empty() && sample.time_s < pieces_.back().last_s() - raw_time_step_s) {
    pieces_.clear();
    count_ = 0;
  }
  if (pieces_.empty() || pieces_.back().since_begin.size() == piece_samples ||
      sample.time_s - pieces_.back().begin_s > longest_piece_s) {
    begin_piece(sample.time_s);
  }
  Piece& piece = pieces_.back();
  const double since_s = std::max(sample.time_s - piece.begin_s, 0.0);
  piece.since_begin.push_back(static_cast<std::uint32_t>(std::lround(since_s / raw_time_step_s)));
  const std::array<double, 10> values{
      sample.current_A,   sample.voltage_V,  sample.position_m, sample.oil_temperature_K, sample.current_a_A,
      sample.voltage_a_V, sample.ports.p_Pa, sample.ports.a_Pa, sample.ports.b_Pa,        sample.ports.t_Pa};
  for (std::size_t k = 0; k < width_; ++k) piece.numbers.push_back(kept(values[k]));
  ++count_;
}

std::string RawTrace::csv(double from_s, double to_s) const {
  struct Row {
    double time_s;
    const float* numbers;
  };
  std::vector<Row> rows;
  // Without current and position it would be no recording: where neither was measured, that is what there is to see.
  std::array<bool, columns.size()> measured{true, false, true};
  if (!pieces_.empty()) from_s = std::max(from_s, pieces_.back().last_s() - length_s_);
  from_s -= 0.5 * raw_time_step_s;
  to_s += 0.5 * raw_time_step_s;
  for (const Piece& piece : pieces_) {
    for (std::size_t k = 0; k < piece.since_begin.size(); ++k) {
      const Row row{piece.time_s(k), piece.numbers.data() + k * width_};
      if (row.time_s < from_s || row.time_s > to_s) continue;
      rows.push_back(row);
      for (std::size_t column = 0; column < width_; ++column) {
        measured[column] = measured[column] || !std::isnan(row.numbers[column]);
      }
    }
  }
  if (rows.empty()) return {};
  const bool both = measured[4];
  std::vector<std::string> header{"time_s"};
  for (std::size_t column = 0; column < width_; ++column) {
    if (measured[column]) header.emplace_back(both ? columns[column].whole_name : columns[column].name);
  }
  std::ostringstream text;
  {
    recording::CsvWriter writer(text);
    writer.header(header);
    for (const Row& row : rows) {
      writer.number(row.time_s, 6);
      for (std::size_t column = 0; column < width_; ++column) {
        if (!measured[column]) continue;
        const Column& of = columns[column];
        writer.number(of.factor * double{row.numbers[column]} + of.offset, of.decimals);
      }
      writer.end_row();
    }
  }
  return text.str();
}

}  // namespace spoolflow::live
