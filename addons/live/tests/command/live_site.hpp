#pragma once
/// A site with one valve for `spoolflow live`, what its page says, and what its store holds.
#include <cstdint>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/command_line.hpp"
#include "tests/apps/running_command.hpp"

namespace spoolflow::apps {

inline constexpr const char* live_header = "time_s,current_A,voltage_V,position_mm,oil_temperature_C\n";

/// So many rows of the header at 1 kHz from that row on, the spool in slow motion to and fro.
[[nodiscard]] std::string live_rows(int count, int from = 0);

class LiveSite : public CommandLine {
 protected:
  void SetUp() override;
  /// site.toml with the valve `v` and this source. `before`: lines in front of the valve.
  void write_site(const std::string& source, const std::string& before = {}) const;
  /// Of the store s.sqlite, a single number; -1 where there is none.
  [[nodiscard]] double kept(const char* sql) const;
  /// Waits until the store has so many samples of the valve, half a minute at most; returns how many there are.
  [[nodiscard]] double kept_samples(double wanted) const;
  /// The port behind the last colon of a line such as "datagrams over UDP at 127.0.0.1:7700".
  [[nodiscard]] static std::uint16_t port_in(const std::string& line);
  /// The valve as /api/v1/valves has it.
  [[nodiscard]] static nlohmann::json valve_at(std::uint16_t page);
  /// The same, once the condition holds of it; after half a minute as it is then.
  template <class Condition>
  [[nodiscard]] static nlohmann::json valve_once(std::uint16_t page, Condition&& condition) {
    nlohmann::json valve;
    for (int k = 0; k < 1500; ++k) {
      valve = valve_at(page);
      if (condition(valve)) return valve;
      rest();
    }
    ADD_FAILURE() << "the valve never was as awaited: " << valve.dump();
    return valve;
  }

 private:
  static void rest();  ///< 20 ms
};

/// A connection to a port of this machine.
class LoopbackSender {
 public:
  explicit LoopbackSender(std::uint16_t port);
  ~LoopbackSender();
  LoopbackSender(const LoopbackSender&) = delete;
  LoopbackSender& operator=(const LoopbackSender&) = delete;
  void send(const std::string& text) const;
  /// All that comes until the other side ends it.
  [[nodiscard]] std::string received() const;

 private:
  int socket_;
};

}  // namespace spoolflow::apps
