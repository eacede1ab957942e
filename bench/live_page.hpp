#pragma once
/// A browser's side of the page of `spoolflow live`, for benchmarks.
#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace spoolflow::bench {

/// What the page at that port of this machine answers. Throws std::runtime_error where there is none.
[[nodiscard]] nlohmann::json asked(std::uint16_t port, const std::string& target);

/// How long samples had waited when their answers came [ms].
struct Waits {
  std::vector<double> ms;
};

/// Listens to a valve's plot until the stop, or until the page ends, which throws.
void follow_plot(std::uint16_t port, const std::string& valve, Waits& waits, const std::stop_token& stop);

}  // namespace spoolflow::bench
