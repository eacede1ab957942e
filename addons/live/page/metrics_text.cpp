/// Of /metrics: Prometheus text format 0.0.4.
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "addons/live/page/api_text.hpp"

namespace spoolflow::live {
namespace {

/// The text as a label's value may hold it; ids hold nothing else.
std::string label(const std::string& id) {
  return fmt::format("{{valve=\"{}\"}}", id);
}

std::string alarm_metrics(const Engine& engine) {
  std::size_t there = 0, unacknowledged = 0, shelved = 0;
  for (const Alarm& alarm : engine.alarms()) {
    if (alarm.shelved_until_ms != 0) {
      ++shelved;
      continue;
    }
    if (alarm.gone_ms == 0) ++there;
    if (alarm.acknowledged_ms == 0) ++unacknowledged;
  }
  return fmt::format(
      "# HELP spoolflow_alarms_raised Alarms that are not gone.\n# TYPE spoolflow_alarms_raised gauge\n"
      "spoolflow_alarms_raised {}\n# HELP spoolflow_alarms_unacknowledged Alarms that nobody has acknowledged.\n"
      "# TYPE spoolflow_alarms_unacknowledged gauge\nspoolflow_alarms_unacknowledged {}\n"
      "# HELP spoolflow_alarms_shelved Alarms that are shelved for a time; the others count none of them.\n"
      "# TYPE spoolflow_alarms_shelved gauge\nspoolflow_alarms_shelved {}\n",
      there, unacknowledged, shelved);
}

/// Nothing where there is no store.
std::string store_metrics(const Engine& engine) {
  if (engine.site().store.empty()) return {};
  const StoreView store = engine.store_view();
  return fmt::format(
      "# HELP spoolflow_store_failing 1 where nothing is kept at present.\n# TYPE spoolflow_store_failing gauge\n"
      "spoolflow_store_failing {}\n# HELP spoolflow_store_mended_total Times that the store's file was deleted or "
      "damaged while the program ran.\n# TYPE spoolflow_store_mended_total counter\nspoolflow_store_mended_total "
      "{}\n",
      store.trouble.empty() ? 0 : 1, store.mendings);
}

/// Nothing where all are off.
std::string output_metrics(const Engine& engine) {
  const std::vector<OutputView> outputs = engine.outputs().views();
  std::string out;
  const auto family = [&](const char* name, const char* type, const char* help, auto&& value) {
    out += fmt::format("# HELP {0} {2}\n# TYPE {0} {1}\n", name, type, help);
    for (const OutputView& one : outputs) out += fmt::format("{}{{output=\"{}\"}} {}\n", name, one.name, value(one));
  };
  if (outputs.empty()) return out;
  family("spoolflow_output_sent_total", "counter", "Frames, answers, messages or blocks that went out.",
         [](const OutputView& one) { return one.sent; });
  family("spoolflow_output_received_total", "counter", "Frames, requests or commands that came in.",
         [](const OutputView& one) { return one.received; });
  family("spoolflow_output_dropped_total", "counter", "What found no room or was given up.",
         [](const OutputView& one) { return one.dropped; });
  family("spoolflow_output_waiting", "gauge",
         "Records that are kept until they can be sent; blocks until the fleet has committed them.",
         [](const OutputView& one) { return one.waiting; });
  family("spoolflow_output_failing", "gauge", "1 where nothing goes out at present.",
         [](const OutputView& one) { return one.trouble.empty() ? 0 : 1; });
  return out;
}

/// Of datagrams and messages before they are samples of a valve.
std::string input_metrics(const Engine& engine) {
  std::string out;
  const UdpCounters udp = engine.udp_counters();
  const auto single = [&](const char* name, const char* help, std::uint64_t value) {
    out += fmt::format("# HELP {0} {1}\n# TYPE {0} counter\n{0} {2}\n", name, help, value);
  };
  single("spoolflow_udp_datagrams_total", "Datagrams that came in.", udp.datagrams);
  single("spoolflow_udp_unreadable_total", "Datagrams that are none of spoolflow.", udp.unreadable);
  single("spoolflow_udp_unknown_valve_total", "Datagrams of no valve of this site.", udp.unknown_valve);
  single("spoolflow_udp_refused_total", "Datagrams of a second sender of a valve's id.", udp.refused);
  single("spoolflow_udp_not_allowed_total", "Datagrams from addresses that may not send.", udp.not_allowed);
  if (engine.messages() != nullptr) {
    const MessageCounters messages = engine.messages()->counters();
    single("spoolflow_mqtt_messages_total", "Messages that came from the broker.", messages.messages);
    single("spoolflow_mqtt_unknown_valve_total", "Messages of no valve of this site.", messages.unknown_valve);
  }
  return out;
}

}  // namespace

std::string metrics_text(const Engine& engine) {
  // Before the first sample nothing is known, and zero would be a flow.
  const auto known = [](const ValveView& valve, double value) { return valve.samples == 0 ? NAN : value; };
  struct Row {
    ValveView valve;
    SourceView source;
  };
  std::vector<Row> rows;
  for (std::size_t k = 0; k < engine.size(); ++k) rows.push_back({engine.view(k), engine.source(k)});
  std::string out = alarm_metrics(engine);
  const auto family = [&](const char* name, const char* type, const char* help, auto&& value) {
    out += fmt::format("# HELP {0} {2}\n# TYPE {0} {1}\n", name, type, help);
    for (const Row& row : rows) {
      const double now = static_cast<double>(value(row));
      out += std::isnan(now) ? fmt::format("{}{} NaN\n", name, label(row.valve.id))
                             : fmt::format("{}{} {}\n", name, label(row.valve.id), now);
    }
  };
  family("spoolflow_flow_cubic_metres_per_second", "gauge", "Flow rate of this instant, signed for whole valves.",
         [&](const Row& row) { return known(row.valve, row.valve.answer.flow_m3_per_s); });
  family("spoolflow_flow_lower_cubic_metres_per_second", "gauge", "Lower end of the 95 % band of the flow rate.",
         [&](const Row& row) { return known(row.valve, row.valve.answer.flow_lower_m3_per_s); });
  family("spoolflow_flow_upper_cubic_metres_per_second", "gauge", "Upper end of the 95 % band of the flow rate.",
         [&](const Row& row) { return known(row.valve, row.valve.answer.flow_upper_m3_per_s); });
  family("spoolflow_pressure_difference_pascals", "gauge", "Pressure difference over the open edge, estimated.",
         [&](const Row& row) { return known(row.valve, row.valve.answer.pressure_difference_Pa); });
  family("spoolflow_ne107", "gauge", "NAMUR NE 107: 0 good, 1 maintenance, 2 out of specification, 3 check, 4 failure.",
         [](const Row& row) { return static_cast<int>(row.valve.condition); });
  family("spoolflow_stalled", "gauge", "1 where no samples come in.",
         [](const Row& row) { return row.source.stalled ? 1 : 0; });
  family("spoolflow_samples_total", "counter", "Samples worked on since the store began.",
         [](const Row& row) { return row.valve.samples; });
  family("spoolflow_energy_joules_total", "counter", "Hydraulic energy through the edge since the store began.",
         [](const Row& row) { return row.valve.energy_J; });
  family("spoolflow_received_samples_total", "counter", "Samples that came in since the program started.",
         [](const Row& row) { return row.source.counters.received; });
  family("spoolflow_dropped_samples_total", "counter", "Of them, those that found no room.",
         [](const Row& row) { return row.source.counters.dropped; });
  family("spoolflow_lost_samples_total", "counter", "Samples that were sent and never came.",
         [](const Row& row) { return row.source.counters.lost; });
  family("spoolflow_repeated_samples_total", "counter", "Samples that had come before.",
         [](const Row& row) { return row.source.counters.repeated; });
  family("spoolflow_unreadable_total", "counter", "Lines that are no samples.",
         [](const Row& row) { return row.source.counters.unreadable; });
  out += store_metrics(engine);
  out += output_metrics(engine);
  out += input_metrics(engine);
  return out;
}

}  // namespace spoolflow::live
