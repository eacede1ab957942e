#include "addons/fleet/pieces/calibrate_pieces.hpp"

#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "addons/fleet/pieces/fleet_work.hpp"
#include "addons/fleet/pieces/piece_kinds.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/apps/work/readable_model.hpp"

namespace spoolflow::apps {
namespace {

/// What calibration has to do with the machine's clock: SOURCE_DATE_EPOCH, where it is set here.
constexpr const char* clock_variable = "SOURCE_DATE_EPOCH";

/// The campaign's folder as far as the campaign needs it.
SentPiece sent_campaign(FleetWork& fleet, const CalibrateArguments& arguments, const recording::Campaign& campaign) {
  const char* const clock = std::getenv(clock_variable);
  SentPiece piece{{.kind = "calibrate",
                   .arguments = fmt::format("{:d} {}", arguments.despite_doubts, clock == nullptr ? "" : clock)}};
  const std::filesystem::path folder = std::filesystem::canonical(campaign.file).parent_path();
  for (const std::filesystem::path& file : files_of(campaign)) {
    const std::string inside =
        file == campaign.file
            ? file.filename().string()
            : std::filesystem::absolute(file)
                  .lexically_normal()
                  .lexically_relative(std::filesystem::absolute(campaign.file).lexically_normal().parent_path())
                  .generic_string();
    if (inside.empty() || inside.starts_with("..")) {
      throw std::invalid_argument(fmt::format(
          "{}: stands outside the campaign's folder {}; --fleet sends what is in it, so copy the file there",
          file.string(), folder.string()));
    }
    fleet.add(piece, file.string(), inside);
  }
  return piece;
}

}  // namespace

/// One campaign on a worker.
fleet::Outcome do_calibrate_piece(const fleet::Piece& piece) {
  const std::size_t gap = piece.arguments.find(' ');
  const bool despite_doubts = piece.arguments.substr(0, gap) == "1";
  const std::string clock = gap == std::string::npos ? "" : piece.arguments.substr(gap + 1);
  if (!clock.empty()) ::setenv(clock_variable, clock.c_str(), 1);
  const model::Model model =
      calibrated(recording::read_campaign(path_of(piece, 0)), despite_doubts, [](const std::string&, double) {});
  constexpr const char* output = "model.json";
  write_piece_file(output, readable_text(model, output));
  return {.files = {{output}}};
}

void calibrate_by_fleet(const CalibrateArguments& arguments, const std::vector<CalibrationTask>& tasks,
                        const Attempt& attempt) {
  FleetWork fleet(arguments.fleet, tool_version(), say_line);
  std::vector<std::size_t> task_of;
  Progress progress("calibrating by the fleet", arguments.quiet);
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    attempt([&] {
      fleet.ask(sent_campaign(fleet, arguments, read_campaign(arguments, tasks[k].campaign)));
      task_of.push_back(k);
    });
  }
  double finished = 0;
  fleet.wait([&](std::size_t number, const fleet::Outcome& outcome) {
    attempt([&] {
      throw_failure(outcome);
      const std::string text = fleet.content(outcome.files.at(0));
      calibrate_one(arguments, tasks[task_of[number]], [&](const recording::Campaign&) {
        return MadeModel{model::parse_model(text, "the fleet's model"), text};
      });
    });
    progress.update(++finished / static_cast<double>(task_of.size()));
  });
}

}  // namespace spoolflow::apps
