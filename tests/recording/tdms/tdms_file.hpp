#pragma once
/// The smallest TDMS files, segment by segment (NI, "TDMS File Format Internal Structure").
#include <string>
#include <vector>

#include "tests/recording/written_bytes.hpp"

namespace spoolflow::recording {

/// Metadata of one segment: objects with their samples' place and their properties.
class TdmsMetadata {
 public:
  static constexpr std::uint32_t i16 = 2, i32 = 3, u32 = 7, f32 = 9, f64 = 10, text_type = 0x20, time = 0x44;

  explicit TdmsMetadata(bool big_endian = false) : big_endian_(big_endian), objects_(big_endian) {}

  /// An object with `count` samples of the type in a chunk.
  TdmsMetadata& channel(const std::string& path, std::uint32_t type, std::uint64_t count) {
    begin(path);
    objects_.u32(type == text_type ? 28 : 20).u32(type).u32(1).u64(count);
    if (type == text_type) objects_.u64(3 * count);
    return *this;
  }
  /// As in the segment before.
  TdmsMetadata& again(const std::string& path) {
    begin(path);
    objects_.u32(0);
    return *this;
  }
  /// A group, the file, or a channel without samples here.
  TdmsMetadata& without(const std::string& path) {
    begin(path);
    objects_.u32(0xFFFFFFFF);
    return *this;
  }
  /// DAQmx: i16 at that byte of rows of `width`.
  TdmsMetadata& daqmx(const std::string& path, std::uint64_t count, std::uint32_t byte, std::uint32_t width) {
    constexpr std::uint32_t numbers = 0x1269, raw = 0xFFFFFFFF, as_i16 = 3;
    begin(path);
    objects_.u32(numbers).u32(raw).u32(1).u64(count);
    objects_.u32(1).u32(as_i16).u32(0).u32(byte).u32(0).u32(0);
    objects_.u32(1).u32(width);
    return *this;
  }
  TdmsMetadata& property(const std::string& name, double value) {
    said().u32(f64).f64(value);
    return named(name);
  }
  TdmsMetadata& property(const std::string& name, std::uint32_t value) {
    said().u32(u32).u32(value);
    return named(name);
  }
  TdmsMetadata& property(const std::string& name, const std::string& value) {
    said().u32(text_type).u32(static_cast<std::uint32_t>(value.size())).raw(value);
    return named(name);
  }
  /// Seconds since 1904.
  TdmsMetadata& start(std::int64_t second, std::uint64_t fraction = 0) {
    said().u32(time);
    big_endian_ ? value_.put(second).u64(fraction) : value_.u64(fraction).put(second);
    return named("wf_start_time");
  }
  [[nodiscard]] std::string content() {
    end();
    return WrittenBytes(big_endian_).u32(count_).raw(objects_.content()).content();
  }
  [[nodiscard]] bool big_endian() const { return big_endian_; }

 private:
  void begin(const std::string& path) {
    end();
    ++count_;
    objects_.u32(static_cast<std::uint32_t>(path.size())).raw(path);
  }
  void end() {
    if (count_ > 0) objects_.u32(properties_count_).raw(properties_.content());
    properties_count_ = 0;
    properties_ = WrittenBytes(big_endian_);
  }
  WrittenBytes& said() { return value_ = WrittenBytes(big_endian_); }
  TdmsMetadata& named(const std::string& name) {
    properties_.u32(static_cast<std::uint32_t>(name.size())).raw(name).raw(value_.content());
    ++properties_count_;
    return *this;
  }

  bool big_endian_;
  WrittenBytes objects_, properties_, value_;
  std::uint32_t count_ = 0, properties_count_ = 0;
};

struct TdmsKind {
  bool interleaved = false, new_objects = true, daqmx = false, unfinished = false;
};

/// A whole segment. `metadata` empty: none, everything as before.
inline std::string tdms_segment(const std::string& metadata, const std::string& samples, TdmsKind kind = {},
                                bool big_endian = false) {
  std::uint32_t contents = 0;
  if (!metadata.empty()) contents |= 1U << 1U;
  if (!metadata.empty() && kind.new_objects) contents |= 1U << 2U;
  if (!samples.empty()) contents |= 1U << 3U;
  if (kind.interleaved) contents |= 1U << 5U;
  if (big_endian) contents |= 1U << 6U;
  if (kind.daqmx) contents |= 1U << 7U;
  WrittenBytes rest(big_endian);
  rest.u32(4713).u64(kind.unfinished ? ~std::uint64_t{0} : metadata.size() + samples.size()).u64(metadata.size());
  return WrittenBytes().raw("TDSm").u32(contents).raw(rest.content()).raw(metadata).raw(samples).content();
}

/// Numbers of a type one behind the other.
template <class Number>
std::string tdms_samples(const std::vector<double>& values, bool big_endian = false) {
  WrittenBytes out(big_endian);
  for (const double value : values) out.put(static_cast<Number>(value));
  return out.content();
}

}  // namespace spoolflow::recording
