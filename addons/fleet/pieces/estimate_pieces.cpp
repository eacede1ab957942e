#include "addons/fleet/pieces/estimate_pieces.hpp"

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "addons/fleet/pieces/fleet_work.hpp"
#include "addons/fleet/pieces/summary_text.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"

namespace spoolflow::apps {
namespace {

/// How a worker is to estimate, as a piece's arguments: "parquet observer 1 machine", where the last two say whether a
/// channel map is among its files, and which environment: a name, "file" where it is the last file, empty: the model's.
struct EstimateWish {
  std::string format{}, estimator{}, maps{}, environment{};
};

std::string text_of_wish(const EstimateWish& wish) {
  return fmt::format("{} {} {} {}", wish.format, wish.estimator, wish.maps, wish.environment);
}

EstimateWish wish_of(const std::string& text) {
  EstimateWish out;
  std::size_t at = 0;
  for (std::string* const field : {&out.format, &out.estimator, &out.maps, &out.environment}) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    *field = text.substr(std::min(at, text.size()), end - std::min(at, text.size()));
    at = end + 1;
  }
  return out;
}

/// A piece with all that the estimate of one recording reads.
SentPiece piece_of(FleetWork& fleet, const EstimateTask& task, const EstimateArguments& arguments, std::size_t k,
                   const std::filesystem::path& target) {
  const bool named = arguments.environment == "bench" || arguments.environment == "machine";
  SentPiece piece{{.kind = "estimate",
                   .arguments = text_of_wish(
                       {.format = std::string(suffix(format_for(task, target))),
                        .estimator = arguments.estimator,
                        .maps = arguments.channels.empty() ? "0" : "1",
                        .environment = named || arguments.environment.empty() ? arguments.environment : "file"})}};
  fleet.add(piece, arguments.model);
  fleet.add(piece, arguments.recordings[k]);
  if (!arguments.channels.empty()) fleet.add(piece, arguments.channels);
  if (!arguments.environment.empty() && !named) fleet.add(piece, arguments.environment);
  return piece;
}

}  // namespace

std::vector<validation::EstimateSummary> estimate_by_fleet(const EstimateTask& task, const EstimateArguments& arguments,
                                                           const std::vector<std::filesystem::path>& targets) {
  if (arguments.recordings.front() == "-")
    throw std::invalid_argument("--fleet sends whole recordings; name a file instead of -");
  FleetWork fleet(arguments.fleet, tool_version(), say_line);
  const std::size_t count = arguments.recordings.size();
  std::vector<std::exception_ptr> failures(count);
  std::vector<validation::EstimateSummary> out(count);
  std::vector<std::size_t> recording_of;
  const auto attempt = [&](std::size_t k, const auto& work) {
    try {
      work();
    } catch (const fleet::ServerRefuses&) {
      throw;
    } catch (...) {
      failures[k] = std::current_exception();
    }
  };
  Progress progress("estimating by the fleet", arguments.quiet);
  for (std::size_t k = 0; k < count; ++k) {
    attempt(k, [&] {
      (void)estimation::open_sensor_channels(arguments.recordings[k],
                                             estimation::sensor_channels(task.model, task.channels));
      fleet.ask(piece_of(fleet, task, arguments, k, targets[k]));
      recording_of.push_back(k);
    });
  }
  std::size_t finished = 0;
  fleet.wait([&](std::size_t number, const fleet::Outcome& outcome) {
    const std::size_t k = recording_of[number];
    attempt(k, [&] {
      throw_failure(outcome);
      OutputFile output(targets[k], task.inputs);
      output.stream() << fleet.content(outcome.files.at(0));
      out[k] = read_summary(outcome.text);
      out[k].file = fleet.sent(number).here(out[k].file);
      for (std::string& doubt : out[k].doubts) doubt = fleet.sent(number).here(doubt);
      output.commit();
    });
    progress.update(static_cast<double>(++finished) / static_cast<double>(recording_of.size()));
  });
  std::erase(failures, nullptr);
  if (!failures.empty()) throw_together(failures);
  return out;
}

/// One recording on a worker.
fleet::Outcome do_estimate_piece(const fleet::Piece& piece) {
  const EstimateWish wish = wish_of(piece.arguments);
  EstimateArguments arguments{
      path_of(piece, 0), {path_of(piece, 1)}, "estimate", wish.estimator, {}, {}, false, {}, true};
  arguments.format = wish.format;
  if (wish.maps == "1") arguments.channels = path_of(piece, 2);
  arguments.environment = wish.environment == "file" ? path_of(piece, piece.files.size() - 1) : wish.environment;
  const validation::EstimateSummary summary =
      estimate_recording(estimate_task(arguments), arguments.recordings.front(), arguments.output, false);
  return {.text = text_of(summary), .files = {{arguments.output}}};
}

}  // namespace spoolflow::apps
