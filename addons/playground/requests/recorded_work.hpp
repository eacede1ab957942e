#pragma once
/// What the commands inspect, calibrate, estimate, validate and simulate do, as requests (playground.hpp).
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace spoolflow::playground {

/// Where progress and files go.
struct Outlet {
  /// Receives the share of the work done, 0 to 1, and the present step.
  std::function<void(double share, std::string_view step)> progress;
  /// Opens a file to be written, or null where it cannot be.
  std::function<std::unique_ptr<std::ostream>(const std::string& file)> opened;
};

/// All of them throw what the command would, and nlohmann::json::exception where the request lacks something.
[[nodiscard]] nlohmann::json inspect(const nlohmann::json& asked, const Outlet& outlet);
[[nodiscard]] nlohmann::json calibrate(const nlohmann::json& asked, const Outlet& outlet);
[[nodiscard]] nlohmann::json estimate(const nlohmann::json& asked, const Outlet& outlet);
[[nodiscard]] nlohmann::json validate(const nlohmann::json& asked, const Outlet& outlet);
[[nodiscard]] nlohmann::json simulate(const nlohmann::json& asked, const Outlet& outlet);

}  // namespace spoolflow::playground
