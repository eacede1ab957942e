#pragma once
/// The samples of one sender from where they began, as far as they are needed to say whether they can be of its valve.
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/plausibility/known_valve.hpp"
#include "spoolflow/plausibility/run_means.hpp"
#include "spoolflow/recording/plausibility.hpp"

namespace spoolflow::live {

/// In bounded memory, half a megabyte at most.
class GatheredSamples {
 public:
  static constexpr std::size_t rows_together = 200;  ///< looked at together
  static constexpr std::size_t channels = 7;

  /// `in_SI`: the sender has no other units, as datagrams have none.
  GatheredSamples(std::string valve, double stroke_m, bool in_SI)
      : valve_(std::move(valve)), stroke_m_(stroke_m), in_SI_(in_SI) {}
  GatheredSamples(const GatheredSamples&) = delete;
  GatheredSamples& operator=(const GatheredSamples&) = delete;

  void take(const estimation::TimedSample& sample);
  /// As a file's numbers are checked at its end.
  void finish();
  /// What no valve has in that unit, in the words of a file's error; empty: nothing yet.
  [[nodiscard]] const std::string& implausible() const { return implausible_; }
  [[nodiscard]] double length_s() const { return last_s_ - first_s_; }
  [[nodiscard]] bool has_gap() const { return means_.gaps().count > 0; }
  /// Whether its spool moves, whatever its unit.
  [[nodiscard]] bool moves() const;
  /// What speaks against them as samples of that valve, a sentence each.
  [[nodiscard]] std::vector<std::string> findings(const std::vector<plausibility::KnownValve>& known) const;

 private:
  struct Range {
    double lowest = std::numeric_limits<double>::infinity(), highest = -std::numeric_limits<double>::infinity();
  };
  /// Whether it says nothing.
  template <class Check>
  bool checked(Check&& check);
  void bind();
  [[nodiscard]] bool is_there(std::size_t channel) const;
  void hand_over();

  std::string valve_;
  double stroke_m_;
  bool in_SI_;
  std::array<std::vector<double>, channels> columns_{};
  std::vector<recording::BoundColumn> bound_{};
  std::optional<recording::Plausibility> units_{};
  plausibility::RunMeans means_{};
  std::string implausible_{};
  std::uint64_t samples_ = 0;
  double first_s_ = estimation::not_measured, last_s_ = 0;
  std::array<Range, channels> ranges_{};
};

}  // namespace spoolflow::live
