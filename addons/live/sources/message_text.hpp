#pragma once
/// Samples in a message of a broker, as lines of CSV.
#include <cstddef>
#include <string>
#include <string_view>

namespace spoolflow::live {

/// More bytes are refused.
inline constexpr std::size_t largest_message = std::size_t{1} << 20U;

struct MessageText {
  std::string header{};     ///< a line without its end; empty: rows alone
  std::string rows{};       ///< whole lines
  std::size_t samples = 0;  ///< lines in `rows`
};

/// CSV, with or without a header; or JSON: an object of a sample, `{"time_s": 1, "current_A": 0.5}`, one of columns
/// that are equally long, `{"time_s": [1, 2], "current_A": [0.5, 0.6]}`, or a list of samples. Columns stand by their
/// names; null is not measured; objects within are passed over. Throws std::invalid_argument with what is wrong.
[[nodiscard]] MessageText message_text(std::string_view message);

}  // namespace spoolflow::live
