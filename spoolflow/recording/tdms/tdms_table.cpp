#include "spoolflow/recording/tdms/tdms_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "spoolflow/recording/bytes/file_bytes.hpp"
#include "spoolflow/recording/tdms/tdms_contents.hpp"
#include "spoolflow/recording/tdms/tdms_pauses.hpp"
#include "spoolflow/recording/tdms/tdms_scale.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t tdms_bytes_at_once = std::size_t{1} << 20U;
constexpr std::uint64_t time_bytes = 16;

/// Where a column's reading has come to.
struct Cursor {
  std::size_t run = 0;
  std::uint64_t first = 0;  ///< sample with which the run begins
};

/// A column of the table.
struct Source {
  std::size_t channel;
  TdmsScale scale;
  Cursor cursor{};
};

class TdmsTable final : public VectorTable {
 public:
  explicit TdmsTable(const std::filesystem::path& path)
      : VectorTable(path.string()), bytes_(path), contents_(read_tdms_contents(bytes_)), buffer_(tdms_bytes_at_once) {
    find_origin();
    std::vector<EvenTimes> times;
    for (const TdmsChannel& channel : contents_.channels) times.push_back(times_of(channel));
    slides_ = why_samples_slide(contents_, times);
    const TdmsProperties& of_file = contents_.of("/");
    for (std::size_t k = 0; k < contents_.channels.size(); ++k) list(k, of_file);
  }

  [[nodiscard]] std::vector<UnreadPart> unread() const override { return unread_; }
  [[nodiscard]] std::string lost() const override {
    return contents_.lost.empty() ? "" : fmt::format("lacks {}; what stands before is read", contents_.lost);
  }

  void copy(std::size_t column, std::uint64_t first, std::size_t count, double* out) override {
    Source& source = sources_[column];
    if (first < source.cursor.first) source.cursor = {};
    std::size_t done = 0;
    for (Cursor& at = source.cursor; done < count; ++at.run) {
      const TdmsRun& run = contents_.runs.at(at.run);
      const TdmsPart* const part = run.chunk->part_of(source.channel);
      const std::uint64_t samples = part == nullptr ? 0 : part->count * run.chunks;
      while (done < count && first + done < at.first + samples) {
        done += take(*part, run, first + done - at.first, count - done, out + done);
      }
      if (done == count) break;  // the run may go on
      at.first += samples;
    }
    source.scale.apply(out, count);
  }

 private:
  /// The earliest instant that is said, from which all times count.
  void find_origin() {
    const auto take = [&](const TdmsTime& time) {
      if (!origin_ || time < *origin_) origin_ = time;
    };
    for (std::size_t k = 0; k < contents_.channels.size(); ++k) {
      const TdmsChannel& channel = contents_.channels[k];
      for (const TdmsWave& wave : channel.waves) {
        if (wave.start) take(*wave.start);
      }
      if (!channel.of_time || channel.samples == 0) continue;
      for (const TdmsRun& run : contents_.runs) {
        const TdmsPart* const part = run.chunk->part_of(k);
        if (part == nullptr || part->count == 0) continue;
        take(time_at(*part, run.at + part->at));
        break;
      }
    }
  }

  void list(std::size_t index, const TdmsProperties& of_file) {
    const TdmsChannel& channel = contents_.channels[index];
    if (channel.samples == 0) return;
    const TdmsProperties& said = contents_.of(channel.path);
    const std::string group = channel.path.substr(0, channel.path.size() - quoted(channel.name).size());
    TdmsScale scale(said, contents_.of(group), of_file);
    const std::string& why = channel.unread.empty() ? scale.unread() : channel.unread;
    const std::string name = channel.group + "/" + channel.name;
    if (!slides_[index].empty()) {
      keep(unread_, {name, fmt::format("channel '{}' {}", name, slides_[index])});
      return;
    }
    if (!why.empty()) {
      keep(unread_,
           {name, fmt::format("channel '{}' holds {}, which is not read; write it as numbers in its unit", name, why)});
      return;
    }
    FileColumn column{name, channel.name, channel.of_time ? "s" : ""};
    if (!channel.of_time) column.unit = channel.said_unit;
    column.wave = times_of(channel);
    add({std::move(column), channel.samples});
    sources_.push_back({index, std::move(scale)});
  }

  /// The channel's part of its path: "/'it''s a name'".
  static std::string quoted(const std::string& name) {
    std::string out = "/'";
    for (const char c : name) out += c == '\'' ? std::string("''") : std::string(1, c);
    return out + "'";
  }

  /// What is said behind the last sample counts only where nothing was said before.
  [[nodiscard]] EvenTimes times_of(const TdmsChannel& channel) const {
    EvenTimes out;
    const TdmsWave* before = nullptr;
    for (const TdmsWave& wave : channel.waves) {
      if (before != nullptr && wave.first >= channel.samples) break;
      double begin_s = wave.offset_s;
      if (wave.start && origin_) begin_s += wave.start->since(*origin_);
      const bool other_rate_alone =
          before != nullptr && before->start == wave.start && before->offset_s == wave.offset_s;
      if (other_rate_alone) begin_s = out.at(wave.first);
      out.go_on({wave.first, begin_s, wave.step_s});
      before = &wave;
    }
    return out;
  }

  [[nodiscard]] TdmsTime time_at(const TdmsPart& part, std::uint64_t at) const {
    std::array<std::uint8_t, time_bytes> raw{};
    bytes_.read(at, raw);
    const std::string& what = bytes_.name();
    ByteReader bytes(raw, part.order, what);
    return read_tdms_time(bytes, part.order);
  }

  /// Samples from `first` of the run on, as many as stand in one chunk and in the buffer; how many.
  std::size_t take(const TdmsPart& part, const TdmsRun& run, std::uint64_t first, std::size_t wanted, double* out) {
    const std::uint64_t chunk = first / part.count, within = first % part.count;
    const std::uint64_t width = part.is_time ? time_bytes : part.number->bytes;
    const std::uint64_t fitting = 1 + (buffer_.size() - width) / part.stride;
    const auto count = static_cast<std::size_t>(std::min({std::uint64_t{wanted}, part.count - within, fitting}));
    const std::uint64_t at = run.at + chunk * run.chunk->bytes + part.at + within * part.stride;
    const std::size_t span = static_cast<std::size_t>((count - 1) * part.stride + width);
    bytes_.read(at, {buffer_.data(), span});
    if (part.is_time) {
      const std::string& what = bytes_.name();
      for (std::size_t k = 0; k < count; ++k) {
        ByteReader bytes({buffer_.data() + k * part.stride, time_bytes}, part.order, what);
        out[k] = read_tdms_time(bytes, part.order).since(*origin_);
      }
      return count;
    }
    read_numbers(*part.number, buffer_.data(), static_cast<std::size_t>(part.stride), count, out);
    if (part.bit >= 0) {
      for (std::size_t k = 0; k < count; ++k) out[k] = std::fmod(std::floor(std::ldexp(out[k], -part.bit)), 2.0);
    }
    return count;
  }

  FileBytes bytes_;
  TdmsContents contents_;
  std::vector<std::uint8_t> buffer_;
  std::vector<Source> sources_;  ///< one a column
  std::optional<TdmsTime> origin_;
  std::vector<std::string> slides_;  ///< why the times of a channel are not known, one a channel; empty where they are
  std::vector<UnreadPart> unread_;
};

}  // namespace

std::unique_ptr<VectorTable> open_tdms_table(const std::filesystem::path& file) {
  return std::make_unique<TdmsTable>(file);
}

}  // namespace spoolflow::recording
