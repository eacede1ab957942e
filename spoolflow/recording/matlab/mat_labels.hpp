#pragma once
/// What a struct of MATLAB says of the numbers in one of its fields: Simulink's "Structure With Time", and timeseries
/// or a Dataset whose properties were saved as structs.
#include <string>
#include <string_view>
#include <vector>

#include <matio.h>

namespace spoolflow::recording {

/// "log.signals(2).values" as the steps to it: variable, then field and element.
struct MatStep {
  std::string field;
  std::size_t element;
};

/// `values` or `data`, which something beside it names.
[[nodiscard]] bool is_labelled_field(std::string_view field);

/// What says something of such a field, and is no channel itself: label, dimensions, blockName, Name, DataInfo, ...
[[nodiscard]] bool is_annotation(std::string_view field);

struct MatLabel {
  std::string name, unit;  ///< empty where nothing says it
  bool of_all = true;      ///< one name for all columns of a matrix; else for that column alone
};

/// Of column `part` of `parts` of the numbers at the end of `path` in `root`, which is read whole: the signal's label,
/// else the Name of timeseries or of the Dataset's element, else the last part of blockName where no other signal of
/// the struct has the same, else what the struct itself is called. A label may be a text a column: a cell, a char
/// matrix or a list with commas.
[[nodiscard]] MatLabel label_of(matvar_t& root, const std::vector<MatStep>& path, std::size_t part, std::size_t parts);

/// The unit of a time: that of TimeInfo, and seconds beside Simulink's signals.
[[nodiscard]] std::string unit_of_time_in(matvar_t& root, const std::vector<MatStep>& path);

}  // namespace spoolflow::recording
