/// `spoolflow demo`: the whole way from bench recordings to a report, on recordings that travel inside the program.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/command_arguments.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/demo_recordings.hpp"
#include "spoolflow/apps/output_file.hpp"

namespace spoolflow::apps {
namespace {

struct Arguments {
  std::string folder = "spoolflow_demo";
  bool quiet = false;
};

void unpack(const std::filesystem::path& folder) {
  make_output_folder(folder);
  for (const EmbeddedFile& file : demo_recordings()) {
    OutputFile output(folder / file.name);
    output.stream().write(file.bytes.data(), static_cast<std::streamsize>(file.bytes.size()));
    output.commit();
  }
}

void demo(const Arguments& arguments) {
  const std::filesystem::path folder = arguments.folder;
  const auto in_folder = [&](const char* name) { return (folder / name).string(); };
  const std::vector<std::string> runs{in_folder("valve_a/ramp_60bar.h5"), in_folder("valve_a/duty_cycle_1.h5")};
  unpack(folder / "valve_a");
  calibrate({.campaign = in_folder("valve_a/campaign.toml"),
             .model = in_folder("model.json"),
             .report = in_folder("calibration.html"),
             .quiet = arguments.quiet});
  estimate({.model = in_folder("model.json"),
            .recording = runs.back(),
            .output = in_folder("estimate.csv"),
            .estimator = {},
            .channels = {},
            .quiet = arguments.quiet});
  validate({.model = in_folder("model.json"),
            .recordings = runs,
            .report = in_folder("report.html"),
            .json = in_folder("metrics.json"),
            .channels = {},
            .quiet = arguments.quiet});
  fmt::print(
      "\nThe recordings are simulated; they, the model and the estimate are in {0}. The same step by step:\n"
      "  spoolflow calibrate {1} -o {2}\n"
      "  spoolflow estimate {2} {4} -o {5}\n"
      "  spoolflow validate {2} {3} {4} --report {6} --json {7}\n\n{6}\n",
      folder.string(), in_folder("valve_a/campaign.toml"), in_folder("model.json"), runs.front(), runs.back(),
      in_folder("estimate.csv"), in_folder("report.html"), in_folder("metrics.json"));
}

}  // namespace

void add_demo_command(CLI::App& program) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      add_command(program, {"demo",
                            "from bench recordings to a report, on recordings inside the program",
                            "nothing: simulated recordings of one valve are inside the program",
                            "a folder with the recordings (valve_a), model.json, estimate.csv, metrics.json, "
                            "calibration.html and report.html; "
                            "the path of the report comes last on standard output",
                            {"spoolflow demo -o demo"}});
  command->add_option("-o,--output", arguments->folder, "folder to write")->capture_default_str();
  add_quiet(*command, arguments->quiet);
  command->callback([arguments] { demo(*arguments); });
}

}  // namespace spoolflow::apps
