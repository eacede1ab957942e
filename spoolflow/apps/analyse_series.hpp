#pragma once
/// What `analyse` is asked, and what its kinds of analysis share.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/analysis/scenario.hpp"
#include "spoolflow/analysis/study.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::apps {

struct AnalyseArguments {
  std::string model;
  std::string scenario;
  std::string json;
  std::string report;
  std::string recording;
  std::string channels;
  std::string self_check;
  std::string fleet;  ///< whose workers do the runs of the study; empty: this machine
  std::vector<std::string> units;
  std::uint32_t samples = 0;  ///< 0: as the scenario says
  std::uint64_t seed = 0;     ///< 0: as the scenario says
  unsigned jobs = 0;          ///< 0: all cores
  std::string direction;      ///< "a" or "b"; empty: that of the model, of a whole valve "b"
  std::string dither_shape = "sine";
  double ripple_limit_percent = 0.5;
  std::size_t series = 0;  ///< virtual units of the model's type to judge; 0: none
  bool dither = false;
  bool print_scenario = false;
  bool quiet = false;
};

/// Of the units of the model's type beside each other (`--series`).
void analyse_series(const AnalyseArguments& arguments);

[[nodiscard]] unsigned workers(const AnalyseArguments& arguments);
[[nodiscard]] analysis::Scenario scenario_of(const AnalyseArguments& arguments);
/// Where an interrupted study keeps its finished runs: beside the output, if that is a file.
[[nodiscard]] std::optional<std::filesystem::path> state_file(const AnalyseArguments& arguments);
/// A study that goes on with what state_file() holds, and saves there.
[[nodiscard]] analysis::StudyWork kept_work(const AnalyseArguments& arguments);
/// The model, or of a whole valve the model of the direction asked for. Throws where the model knows another one only.
[[nodiscard]] model::Model model_of(const AnalyseArguments& arguments);
/// All files that are read. `valve_file`: what else the scenario reads; empty: nothing.
[[nodiscard]] std::vector<std::filesystem::path> inputs_of(const AnalyseArguments& arguments,
                                                           const std::string& valve_file = {});
void print_lines(const std::string& text);

}  // namespace spoolflow::apps
