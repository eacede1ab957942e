#include "spoolflow/apps/analyse_arguments.hpp"

#include <fstream>

#include <fmt/format.h>

#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/suggestion.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/parallel/for_each.hpp"

namespace spoolflow::apps {
namespace {

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace

void print_lines(const std::string& text) {
  print_text(terminal_lines(text));
  flush_standard_output();
}

unsigned workers(const AnalyseArguments& arguments) {
  return arguments.jobs == 0 ? parallel::cores() : arguments.jobs;
}

analysis::Scenario scenario_of(const AnalyseArguments& arguments) {
  analysis::Scenario scenario;
  if (!arguments.scenario.empty()) scenario = analysis::read_scenario(arguments.scenario);
  if (arguments.samples != 0) scenario.study.base_samples = arguments.samples;
  if (arguments.seed != 0) scenario.seed = arguments.seed;
  return scenario;
}

std::optional<std::filesystem::path> state_file(const AnalyseArguments& arguments) {
  for (const std::string& output : {arguments.json, arguments.report}) {
    if (!output.empty() && output != "-" && !output.starts_with("/dev/")) return output + ".study";
  }
  return std::nullopt;
}

analysis::StudyWork kept_work(const AnalyseArguments& arguments) {
  analysis::StudyWork work{.identity = std::string(tool_version()), .workers = workers(arguments)};
  if (const std::optional<std::filesystem::path> state = state_file(arguments)) {
    work.saved = bytes_of(*state);
    work.save = [file = *state](const std::string& text) {
      OutputFile output(file);
      output.stream() << text;
      output.commit();
    };
  }
  return work;
}

model::Model model_of(const AnalyseArguments& arguments) {
  std::vector<Input> roles{{arguments.model, FileKind::model}};
  if (!arguments.recording.empty()) roles.push_back({arguments.recording, FileKind::recording, "--recording "});
  refuse_other_kinds("analyse", roles);
  model::Model model = model::read_model(arguments.model);
  if (model.whole()) return model::of_direction(model, arguments.direction.empty() ? "b" : arguments.direction);
  if (!arguments.direction.empty() && arguments.direction != model.valve.direction) {
    throw model::ModelError(
        fmt::format("{}: --direction {}: the model knows direction \"{}\" only; leave the option out, "
                    "or calibrate the whole valve",
                    arguments.model, arguments.direction, model.valve.direction));
  }
  return model;
}

}  // namespace spoolflow::apps
