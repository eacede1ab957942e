#include "addons/fleet/pieces/study_pieces.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "addons/fleet/pieces/fleet_work.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"

namespace spoolflow::apps {
namespace {

constexpr double simulated_s_per_piece = 64;  // some seconds of work

/// The study as a piece's arguments and files hold it.
struct PieceOfStudy {
  model::Model given, with;
  analysis::Scenario scenario;
  std::size_t from, to;  ///< numbers of runs, [from, to)
};

PieceOfStudy read_study(const fleet::Piece& piece) {
  const nlohmann::json arguments = nlohmann::json::parse(piece.arguments);
  PieceOfStudy out{model::read_model(path_of(piece, 0)), {}, {}, 0, 0};
  if (out.given.whole()) out.given = model::of_direction(out.given, arguments.at("direction").get<std::string>());
  std::size_t next = 1;
  out.with = arguments.at("own_model").get<bool>() ? model::read_model(path_of(piece, next++)) : out.given;
  if (arguments.at("scenario").get<bool>()) out.scenario = analysis::read_scenario(path_of(piece, next++));
  if (arguments.at("valve").get<bool>()) out.scenario.study.valve = path_of(piece, next++);
  out.scenario.study.given_model = !arguments.at("own_model").get<bool>();
  out.scenario.study.base_samples = arguments.at("base_samples").get<double>();
  out.scenario.seed = arguments.at("seed").get<std::uint64_t>();
  out.from = arguments.at("from").get<std::size_t>();
  out.to = arguments.at("to").get<std::size_t>();
  return out;
}

}  // namespace

analysis::RunsWork study_by_fleet(const StudyInputs& inputs) {
  const auto work = std::make_shared<FleetWork>(inputs.fleet, tool_version(), say_line);
  return [work, inputs](const analysis::StudyRuns& runs, const std::string& own_model,
                        const std::vector<std::size_t>& numbers, const auto& finished) {
    FleetWork& fleet = *work;
    SentPiece common{{.kind = "study"}};
    fleet.add(common, inputs.model_file);
    if (!own_model.empty()) fleet.add_text(common, "virtual_valve.json", own_model);
    const std::string& valve = inputs.scenario.study.valve;
    const bool has_valve = valve.ends_with(".toml");
    if (!inputs.scenario_file.empty()) fleet.add(common, inputs.scenario_file);
    if (has_valve) fleet.add(common, valve);
    const std::size_t total = runs.design().points();
    const auto size = static_cast<std::size_t>(std::max(1.0, simulated_s_per_piece / inputs.scenario.study.run_s));
    std::map<std::size_t, std::vector<std::size_t>> open;  // by the piece
    // The same runs are in the same piece, whatever was finished before.
    std::map<std::size_t, std::vector<std::size_t>> by_place;
    for (const std::size_t number : numbers) by_place[number / size].push_back(number);
    for (const auto& [place, of_piece] : by_place) {
      SentPiece piece = common;
      piece.piece.arguments = nlohmann::json{{"scenario", !inputs.scenario_file.empty()},
                                             {"valve", has_valve},
                                             {"own_model", !own_model.empty()},
                                             {"direction", inputs.direction},
                                             {"base_samples", inputs.scenario.study.base_samples},
                                             {"seed", inputs.scenario.seed},
                                             {"from", place * size},
                                             {"to", std::min(total, (place + 1) * size)}}
                                  .dump();
      open[fleet.ask(std::move(piece))] = of_piece;
    }
    fleet.wait([&](std::size_t piece, const fleet::Outcome& outcome) {
      throw_failure(outcome);
      const analysis::FinishedRuns done = analysis::finished_runs(outcome.text, runs.fingerprint(), total);
      for (const std::size_t number : open[piece]) {
        if (!done[number]) throw fleet::PieceError("runs of a study came back as those of another one");
        finished(number, *done[number]);
      }
    });
  };
}

fleet::Outcome do_study_piece(const fleet::Piece& piece, const std::string& identity) {
  const PieceOfStudy study = read_study(piece);
  const analysis::StudyRuns runs(study.given, study.scenario, analysis::study_valve(study.given, study.scenario),
                                 identity);
  analysis::FinishedRuns done(runs.design().points());
  std::vector<std::size_t> numbers(std::min(study.to, done.size()) - study.from);
  std::iota(numbers.begin(), numbers.end(), study.from);
  const std::size_t at_once = runs.runs_at_once(numbers.size(), 1);
  for (std::size_t first = 0; first < numbers.size(); first += at_once) {
    const auto some = std::span(numbers).subspan(first, std::min(at_once, numbers.size() - first));
    const std::vector<analysis::RunErrors> errors = runs.run(study.with, some);
    for (std::size_t k = 0; k < some.size(); ++k) done[some[k]] = errors[k];
  }
  return {.text = analysis::study_state(runs.fingerprint(), done)};
}

}  // namespace spoolflow::apps
