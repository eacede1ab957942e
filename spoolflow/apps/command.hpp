#pragma once
/// What a command's help says, and the options that commands share.
#include <cstdint>
#include <string>
#include <vector>

#include "spoolflow/recording/channel_map.hpp"

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace spoolflow::apps {

struct CommandText {
  std::string name;                   ///< as typed: "estimate"
  std::string purpose;                ///< one line, also shown in the overview of `spoolflow --help`
  std::string reads;                  ///< the inputs and what they must hold
  std::string writes;                 ///< the outputs and what they hold
  std::vector<std::string> examples;  ///< whole command lines; the first is shown in the overview as well
};

/// Adds the command with its help; the caller adds its arguments and callback.
CLI::App* add_command(CLI::App& program, const CommandText& text);

/// Gives the program's help, and that of every command added later, its form: arguments in capitals, required options
/// in the usage line, columns that fit.
void shape_help_page(CLI::App& program);

/// Those that the overview names.
[[nodiscard]] std::vector<const CLI::App*> commands_of(const CLI::App& program);
/// As typed: "--output", "-o".
[[nodiscard]] std::vector<std::string> option_names(const CLI::App& command);

/// A number from `lowest` to `highest`; NaN is none.
CLI::Validator between(double lowest, double highest);
/// A whole number from `lowest` on, written in digits.
CLI::Validator whole_number_from(std::uint64_t lowest);

/// `-q,--quiet`: no progress.
void add_quiet(CLI::App& command, bool& quiet);

/// `--fleet FLEET.toml`: workers of a fleet do what falls into pieces. `which`: "of the global study".
CLI::Option* add_fleet_option(CLI::App& command, std::string& fleet, const std::string& which);
/// `--channels MAP.toml`: a channel map.
void add_channels_option(CLI::App& command, std::string& channels);
/// The map of a file, none where no file is named. Throws RecordingError.
[[nodiscard]] recording::ChannelMap channels_from(const std::string& file);
/// `environment` stays empty where nobody asks: then it is the model's.
CLI::Option* add_environment_option(CLI::App& command, std::string& environment);

/// `--units LIST`: the units of the report.
void add_units(CLI::App& command, std::vector<std::string>& units);

}  // namespace spoolflow::apps
