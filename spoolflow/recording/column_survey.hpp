#pragma once
/// A file's columns by their numbers, whatever they are called: what a column could be by how it moves.
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/recording/channels/channel.hpp"
#include "spoolflow/recording/open_table.hpp"
#include "spoolflow/recording/reader.hpp"

namespace spoolflow::recording {

/// A column as the file holds it: in its own unit, whatever that is.
struct SurveyedColumn {
  std::string name, unit;          ///< unit: as the file states it; empty where it does not
  double lowest = 0, highest = 0;  ///< NaN without numbers
  std::uint64_t samples = 0;       ///< finite numbers
  TextCells text{};
  InfiniteSamples infinite{};
  std::uint64_t rows = 0;           ///< with the missing ones; only columns of as many are compared
  std::optional<Channel> said{};    ///< what a word of its name stands for
  bool rises = false;               ///< each number lies above the one before
  std::vector<double> beginning{};  ///< at most 20,000 samples; NaN where one is missing
};

/// Reads every column, 64 of a length by an opening of their own; at most 1024 columns of a length, and of 16 lengths
/// (the others: no rows). Those beyond the first 64 of a length have no `beginning`. `open`: tables that let infinite
/// numbers pass. Throws RecordingError as reading does.
[[nodiscard]] std::vector<SurveyedColumn> survey_columns(const std::function<std::unique_ptr<SampleTable>()>& open);

struct DataGuess {
  std::size_t column;
  std::string why;  ///< "it rises before 'weg' does"
};

/// For those channels of time, current, voltage, position and oil temperature that `known` (channel to column) lacks,
/// the column among those that are not known which behaves like it: time rises with every sample; the current rises
/// before the position does; the voltage goes along with the current, not after it; an oil temperature drifts slowly
/// between 5 and 120 degC or 278 and 393 K. None where no column does, and none where several rise with every sample or
/// drift: their order in the file says nothing. The unit of a column, where stated,
/// must fit, and a word of its name must not stand for another channel.
[[nodiscard]] std::map<Channel, DataGuess> guess_by_data(const std::vector<SurveyedColumn>& columns,
                                                         std::map<Channel, std::size_t> known);

/// What else a column could be, or why it holds no numbers, in words; empty where nothing can be said: "stands still",
/// "could be a pressure in Pa", "no numbers: all 300 samples are missing", "text in 3 of 300 cells, such as ...".
[[nodiscard]] std::string character_of(const SurveyedColumn& column);

}  // namespace spoolflow::recording
