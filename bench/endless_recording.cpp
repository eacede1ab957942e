#include "bench/endless_recording.hpp"

#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <unistd.h>

namespace spoolflow::bench {
namespace {

void write_all(int descriptor, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(descriptor, text.data() + done, text.size() - done);
    if (written < 0) throw std::runtime_error("the reader stopped before the end");
    done += static_cast<std::size_t>(written);
  }
}

}  // namespace

EndlessRecording::EndlessRecording(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  text_.assign(std::istreambuf_iterator<char>(in), {});
  if (!text_.starts_with("time_s,")) throw std::runtime_error(file + ": the first column is not time_s");
  std::string_view left(text_);
  while (!left.empty()) {
    const std::size_t end = left.find('\n');
    const std::string_view line = left.substr(0, end == std::string_view::npos ? end : end + 1);
    left.remove_prefix(line.size());
    if (header_.empty()) {
      header_ = line;
      continue;
    }
    double time_s = 0;
    const auto read = std::from_chars(line.data(), line.data() + line.size(), time_s);
    rows_.push_back({time_s, line.substr(static_cast<std::size_t>(read.ptr - line.data()))});
  }
  if (rows_.size() < 2) throw std::runtime_error(file + ": fewer than two rows");
  const double span_s = rows_.back().time_s - rows_.front().time_s;
  period_s_ = span_s + span_s / static_cast<double>(rows_.size() - 1);
}

std::uint64_t EndlessRecording::write(int descriptor, std::uint64_t bytes) const {
  constexpr std::size_t block_bytes = 1 << 18;
  std::string block(header_);
  std::uint64_t rows = 0;
  std::array<char, 32> time{};
  for (std::uint64_t written = 0; written < bytes;) {
    const double time_s = rows_[rows % rows_.size()].time_s + period_s_ * static_cast<double>(rows / rows_.size());
    const auto end = std::to_chars(time.begin(), time.end(), time_s, std::chars_format::fixed, 4);
    block.append(time.data(), end.ptr).append(rows_[rows % rows_.size()].rest);
    ++rows;
    if (block.size() < block_bytes && written + block.size() < bytes) continue;
    write_all(descriptor, block);
    written += block.size();
    block.clear();
  }
  return rows;
}

}  // namespace spoolflow::bench
