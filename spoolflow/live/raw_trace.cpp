#include "spoolflow/live/raw_trace.hpp"

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

/// Grows while the samples are few, and by doubling: nobody says how fast they will come.
void RawTrace::make_room() {
  const std::size_t before = time_s_.size();
  if (count_ < before) return;
  std::rotate(time_s_.begin(), time_s_.begin() + static_cast<std::ptrdiff_t>(first_), time_s_.end());
  std::rotate(numbers_.begin(), numbers_.begin() + static_cast<std::ptrdiff_t>(first_ * width_), numbers_.end());
  first_ = 0;
  const std::size_t room = std::min(most_samples, std::max<std::size_t>(1024, before + before / 2));
  time_s_.resize(room);
  numbers_.resize(room * width_);
}

void RawTrace::add(const estimation::TimedSample& sample) {
  if (length_s_ <= 0 || !std::isfinite(sample.time_s)) return;
  const auto time_of = [this](std::size_t k) { return time_s_[(first_ + k) % time_s_.size()]; };
  if (count_ > 0 && sample.time_s < time_of(count_ - 1)) count_ = 0;
  while (count_ > 0 && (time_of(0) < sample.time_s - length_s_ || count_ == most_samples)) {
    first_ = (first_ + 1) % time_s_.size();
    --count_;
  }
  make_room();
  const std::size_t at = (first_ + count_) % time_s_.size();
  time_s_[at] = sample.time_s;
  const std::array<double, 10> values{
      sample.current_A,   sample.voltage_V,  sample.position_m, sample.oil_temperature_K, sample.current_a_A,
      sample.voltage_a_V, sample.ports.p_Pa, sample.ports.a_Pa, sample.ports.b_Pa,        sample.ports.t_Pa};
  for (std::size_t k = 0; k < width_; ++k) numbers_[at * width_ + k] = kept(values[k]);
  ++count_;
}

std::string RawTrace::csv(double from_s, double to_s) const {
  std::vector<std::size_t> rows;
  // Without current and position it would be no recording: where neither was measured, that is what there is to see.
  std::array<bool, columns.size()> measured{true, false, true};
  for (std::size_t k = 0; k < count_; ++k) {
    const std::size_t at = (first_ + k) % time_s_.size();
    if (time_s_[at] < from_s || time_s_[at] > to_s) continue;
    rows.push_back(at);
    for (std::size_t column = 0; column < width_; ++column) {
      measured[column] = measured[column] || !std::isnan(numbers_[at * width_ + column]);
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
    for (const std::size_t at : rows) {
      writer.number(time_s_[at], 6);
      for (std::size_t column = 0; column < width_; ++column) {
        if (!measured[column]) continue;
        const Column& of = columns[column];
        writer.number(of.factor * double{numbers_[at * width_ + column]} + of.offset, of.decimals);
      }
      writer.end_row();
    }
  }
  return text.str();
}

}  // namespace spoolflow::live
