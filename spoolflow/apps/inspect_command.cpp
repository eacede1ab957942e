/// `spoolflow inspect`: what a recording holds, and a channel map for foreign column names.

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/terminal/input_kind.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/work/inspection_text.hpp"
#include "spoolflow/recording/inspection.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::apps {
namespace {

struct InspectArguments {
  std::string file;
  std::string channels;
  std::string protocol;
  double stroke_mm = 0;
  bool json = false;
  bool quiet = false;
};

recording::Protocol protocol_named(const std::string& written) {
  return *std::ranges::find(recording::all_protocols, written,
                            [](recording::Protocol protocol) { return recording::name(protocol); });
}

/// Of a folder: what its recordings are, and what is missing for which model.
void inspect_folder(const InspectArguments& arguments) {
  if (!arguments.protocol.empty() || !arguments.channels.empty() || arguments.stroke_mm > 0) {
    throw std::invalid_argument(
        fmt::format("{} is a folder: --protocol, --channels and --stroke-mm are of one recording; leave them out, or "
                    "write a campaign.toml that has them",
                    arguments.file));
  }
  std::vector<FolderEntry> entries;
  {
    Progress progress("reading the folder", arguments.quiet);
    entries = folder_entries(arguments.file);
  }
  print_text(arguments.json ? folder_json(entries) : folder_text(arguments.file, entries));
}

/// The bytes of a pipe come once, and `inspect` looks at them more than once.
void refuse_pipe(const std::string& file) {
  std::error_code failure;
  if (file == "-" || !std::filesystem::is_fifo(file, failure)) return;
  throw std::invalid_argument(
      fmt::format("{0}: is a pipe; give what it holds on standard input: spoolflow inspect - < {0}", file));
}

void inspect(const InspectArguments& arguments) {
  refuse_pipe(arguments.file);
  if (std::error_code failure; std::filesystem::is_directory(arguments.file, failure)) return inspect_folder(arguments);
  if (arguments.protocol.empty() && inspect_image(arguments.file, arguments.json)) return;
  if (!arguments.protocol.empty() && arguments.file == "-") {
    throw std::invalid_argument(
        "--protocol is for a recording that is named, not for standard input; write it to a file");
  }
  refuse_other_kinds("inspect", {{arguments.file, FileKind::recording}});
  recording::ReadOptions options;
  options.channels = channels_from(arguments.channels);
  if (arguments.stroke_mm > 0) options.stroke_m = units::m_from_mm(arguments.stroke_mm);
  recording::Inspection found;
  {
    Progress progress("inspecting", arguments.quiet);
    found = recording::inspect(arguments.file, options,
                               [&](std::optional<double> share, std::uint64_t rows) { progress.update(share, rows); });
  }
  std::optional<calibration::ProtocolFit> fit;
  if (!arguments.protocol.empty()) {
    fit = fit_of_inspected(arguments.file, options, found, protocol_named(arguments.protocol));
  }
  if (arguments.json) {
    print_text(inspection_json(found, fit ? &*fit : nullptr));
  } else {
    print_text(inspection_text({.file = arguments.file == "-" ? "standard input" : arguments.file,
                                .map_file = arguments.channels,
                                .map = options.channels,
                                .found = found}));
    if (fit) print_text(protocol_text(*fit));
  }
  if (fit && !fit->missing.empty()) {
    throw std::runtime_error(fmt::format("{} does not serve protocol {}: {} of its channels {}, as said above",
                                         arguments.file, arguments.protocol, fit->missing.size(),
                                         fit->missing.size() == 1 ? "is missing" : "are missing"));
  }
}

}  // namespace

void add_inspect_command(CLI::App& program) {
  auto arguments = std::make_shared<InspectArguments>();
  CLI::App* command = add_command(
      program,
      {"inspect",
       "show what a recording, a folder, or a flash page of parameters holds",
       "a recording: CSV (comma, semicolon or tab; decimal comma; - for CSV from standard input), MATLAB v5 or v7.3, "
       "HDF5, TDMS, MDF 4, Excel (.xlsx); a folder of them, or with a campaign.toml; or parameters from `spoolflow "
       "export parameters`",
       "on standard output: channels, units, rate, gaps, clipping, what each column could be by its name and its "
       "numbers, what is missing, and a channel map to paste. Of a folder: the protocol of each recording, and what is "
       "missing for which kind of model, in minutes on the bench. Of parameters: valve, model, versions, tables, "
       "whether "
       "the "
       "sensor takes them; where it does not, the exit status is 2",
       {"spoolflow inspect run.csv", "spoolflow inspect rig.mat --channels map.toml",
        "spoolflow inspect spring.csv --protocol spring", "spoolflow inspect campaign",
        "spoolflow inspect valve.bin"}});
  command->add_option("file", arguments->file, "recording, folder of recordings, or parameters")->required();
  add_channels_option(*command, arguments->channels);
  command->add_option("--stroke-mm", arguments->stroke_mm, "the valve's stroke, for positions in percent")
      ->type_name("MM")
      ->check(between(0.01, 50.0));
  std::vector<std::string> protocols;
  for (const recording::Protocol protocol : recording::all_protocols) protocols.emplace_back(recording::name(protocol));
  command
      ->add_option("--protocol", arguments->protocol, "whether the file has the channels of this test; status 1 if not")
      ->option_text("NAME")
      ->check(CLI::IsMember(protocols));
  command->add_flag("--json", arguments->json, "print JSON instead of text");
  add_quiet(*command, arguments->quiet);
  command->callback([arguments] { inspect(*arguments); });
}

}  // namespace spoolflow::apps
