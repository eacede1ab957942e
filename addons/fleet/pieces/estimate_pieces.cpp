#include "addons/fleet/pieces/estimate_pieces.hpp"

#include <exception>

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

std::vector<validation::EstimateSummary> estimate_by_fleet(const EstimateTask& task, const EstimateArguments& arguments,
                                                           const std::vector<std::filesystem::path>& targets) {
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
      const auto as = suffix(format_for(task, targets[k]));
      SentPiece piece{{.kind = "estimate", .arguments = fmt::format("{} {}", as, arguments.estimator)}};
      fleet.add(piece, arguments.model);
      fleet.add(piece, arguments.recordings[k]);
      if (!arguments.channels.empty()) fleet.add(piece, arguments.channels);
      fleet.ask(std::move(piece));
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
  const std::size_t gap = piece.arguments.find(' ');
  EstimateArguments arguments{
      path_of(piece, 0), {path_of(piece, 1)}, "estimate", piece.arguments.substr(gap + 1), {}, {}, false, {}, true};
  arguments.format = piece.arguments.substr(0, gap);
  if (piece.files.size() > 2) arguments.channels = path_of(piece, 2);
  const validation::EstimateSummary summary =
      estimate_recording(estimate_task(arguments), arguments.recordings.front(), arguments.output, false);
  return {.text = text_of(summary), .files = {{arguments.output}}};
}

}  // namespace spoolflow::apps
