/// `spoolflow history`: what a store of `spoolflow live` keeps of a valve, as CSV.
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "addons/live/history/store.hpp"
#include "addons/live/program/live_commands.hpp"
#include "addons/live/valve/utc_text.hpp"
#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/estimation/status_text.hpp"
#include "spoolflow/recording/files/csv_writer.hpp"
#include "spoolflow/recording/written_tables/table_format.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::apps {
namespace {

struct HistoryArguments {
  std::string store, valve, from, to, output;
  std::optional<std::int64_t> recording{};  ///< of raw samples; none: the history
};

/// Milliseconds since 1970 of "2026-11-22", "2026-11-22T10:30", "2026-11-22T10:30:00Z" (all UTC) or seconds since 1970.
std::int64_t instant_ms(const std::string& text, const char* option) {
  const char* const last = text.c_str() + text.size();
  for (const char* form : {"%Y-%m-%dT%H:%M:%SZ", "%Y-%m-%dT%H:%M:%S", "%Y-%m-%dT%H:%M", "%Y-%m-%d"}) {
    std::tm parts{};
    if (::strptime(text.c_str(), form, &parts) != last) continue;
    const int day = parts.tm_mday;
    const std::int64_t seconds = ::timegm(&parts);  // which makes of February 30 a day of March
    if (parts.tm_mday == day) return 1000 * seconds;
  }
  char* end = nullptr;
  const double seconds = std::strtod(text.c_str(), &end);
  if (!text.empty() && end == last && std::abs(seconds) < 1e12) return std::llround(1e3 * seconds);
  throw std::invalid_argument(fmt::format(
      "{}: '{}' is no instant; write 2026-11-22, 2026-11-22T10:30:00Z (UTC), or seconds since 1970", option, text));
}

/// Raw samples that were kept around an alarm.
void raw_samples(const HistoryArguments& arguments) {
  const auto recording = live::read_recording(arguments.store, *arguments.recording);
  if (!recording) {
    throw std::invalid_argument(
        fmt::format("{}: holds no recording {}; /api/v1/recordings of spoolflow live lists them, "
                    "and its events name them",
                    arguments.store, *arguments.recording));
  }
  OutputFile output(arguments.output, {arguments.store});
  output.stream() << recording->csv;
  output.commit();
}

void history(const HistoryArguments& arguments) {
  recording::refuse_other_than_csv(arguments.output);
  if (arguments.recording) {
    if (!arguments.valve.empty() || !arguments.from.empty() || !arguments.to.empty())
      throw std::invalid_argument(
          "--recording names raw samples of one valve and time; leave --valve, --from and --to away");
    raw_samples(arguments);
    return;
  }
  if (arguments.valve.empty())
    throw std::invalid_argument("name a valve with --valve, or raw samples with --recording");
  constexpr std::int64_t all = std::numeric_limits<std::int64_t>::max();
  const std::int64_t from_ms = arguments.from.empty() ? 0 : instant_ms(arguments.from, "--from");
  const std::int64_t to_ms = arguments.to.empty() ? all : instant_ms(arguments.to, "--to");
  if (from_ms >= to_ms) throw std::invalid_argument("--from must lie before --to");
  OutputFile output(arguments.output, {arguments.store});
  std::uint64_t rows = 0;
  {
    recording::CsvWriter writer(output.stream());
    writer.header({"time_utc", "time_s", "samples", "flow_min_L_min", "flow_mean_L_min", "flow_max_L_min",
                   "flow_lower_L_min", "flow_upper_L_min", "energy_J", "status"});
    estimation::StatusText status_text;
    live::read_history(arguments.store, arguments.valve, from_ms, to_ms, [&](const live::HistoryRow& row) {
      const live::Summary& of = row.summary;
      writer.text(live::utc(row.wall_ms));
      writer.number(of.time_s, 6);
      writer.number(static_cast<double>(of.samples), 0);
      for (const double flow : {of.flow_min_m3_per_s, of.flow_mean_m3_per_s, of.flow_max_m3_per_s,
                                of.lower_min_m3_per_s, of.upper_max_m3_per_s}) {
        writer.number(flow * units::litre_per_minute_per_m3_per_s, 6);
      }
      writer.number(of.energy_J, 3);
      writer.text(status_text(static_cast<sensor::Status>(of.status)));
      writer.end_row();
      ++rows;
    });
    writer.flush();
  }
  output.commit();
  if (rows == 0) say_line(fmt::format("note: {} keeps nothing of {} in that time", arguments.store, arguments.valve));
}

}  // namespace

void add_history_command(CLI::App& program) {
  auto arguments = std::make_shared<HistoryArguments>();
  CLI::App* command =
      add_command(program, {"history",
                            "write what a store of `spoolflow live` keeps of a valve",
                            "STORE.sqlite of `spoolflow live --store`, also while that is running",
                            "CSV, one row a second: smallest, mean and largest flow, the band's ends, energy, status",
                            {"spoolflow history site.sqlite --valve press_1 -o press_1.csv",
                             "spoolflow history site.sqlite --recording 3 -o alarm.csv",
                             "spoolflow history site.sqlite --valve press_1 --from 2026-11-22T10:00 -o -"}});
  command->add_option("store", arguments->store, "store")->type_name("STORE.sqlite")->required();
  command->add_option("--valve", arguments->valve, "the valve's id")->type_name("ID");
  command
      ->add_option("--from", arguments->from,
                   "instant (UTC) of the first row, such as\n2026-11-22T10:00; without it from the beginning")
      ->type_name("TIME");
  command->add_option("--to", arguments->to, "instant (UTC) before which the rows end; without\nit to the end")
      ->type_name("TIME");
  command
      ->add_option("--recording", arguments->recording,
                   "instead of the history the raw samples kept around\nan alarm, as a recording")
      ->type_name("NUMBER");
  command->add_option("-o,--output", arguments->output, "CSV file to write, - for standard output")
      ->type_name("CSV")
      ->required();
  command->callback([arguments] { history(*arguments); });
}

}  // namespace spoolflow::apps
