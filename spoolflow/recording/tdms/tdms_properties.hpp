#pragma once
/// What a TDMS file says about its channels, groups and itself.
#include <cstdint>
#include <map>
#include <string>
#include <variant>

#include "spoolflow/recording/bytes/byte_reader.hpp"

namespace spoolflow::recording {

/// Seconds since 1904-01-01 UTC and 2^-64 of a second.
struct TdmsTime {
  std::int64_t second = 0;
  std::uint64_t fraction = 0;

  [[nodiscard]] double since(const TdmsTime& origin) const;
  auto operator<=>(const TdmsTime&) const = default;
};
[[nodiscard]] TdmsTime read_tdms_time(ByteReader& bytes, ByteOrder order);

/// Of one object, by name: numbers, texts, times.
class TdmsProperties {
 public:
  using Value = std::variant<double, std::string, TdmsTime>;

  /// Reads as many as are said to follow, a later value in the place of an earlier one. Only what the reader asks for
  /// is kept: names that begin with wf_, unit_string, NI_. Throws RecordingError: a type that is not known (`what`:
  /// whose they are).
  void read(ByteReader& bytes, ByteOrder order, const std::string& what);

  /// Null where there is none of that name and type.
  [[nodiscard]] const double* number(const std::string& name) const { return as<double>(name); }
  [[nodiscard]] const std::string* text(const std::string& name) const { return as<std::string>(name); }
  [[nodiscard]] const TdmsTime* time(const std::string& name) const { return as<TdmsTime>(name); }

 private:
  template <class Kind>
  [[nodiscard]] const Kind* as(const std::string& name) const {
    const auto found = values_.find(name);
    return found == values_.end() ? nullptr : std::get_if<Kind>(&found->second);
  }
  std::map<std::string, Value> values_;
};

}  // namespace spoolflow::recording
