#pragma once
/// What attributes of an HDF5 file say of its datasets and groups.
#include <optional>
#include <string>

#include <hdf5.h>

#include "spoolflow/recording/files/clock_time.hpp"

namespace spoolflow::recording {

/// Of fixed or variable length; empty where there is no such text.
[[nodiscard]] std::string text_attribute(hid_t object, const char* name);

/// Nothing where there is no such number.
[[nodiscard]] std::optional<double> optional_number_attribute(hid_t object, const char* name);
[[nodiscard]] double number_attribute(hid_t object, const char* name, double otherwise);

/// An instant as text, or as a number of seconds; nothing where it is neither.
[[nodiscard]] std::optional<ClockTime> start_attribute(hid_t object, const char* name);

/// The start_time of the group that holds the dataset, or of the nearest one around it that states one.
[[nodiscard]] std::optional<ClockTime> start_of_group(hid_t file, const std::string& path);

/// An attribute that looks like a scale, is not 1 and is not read; empty: none.
[[nodiscard]] std::string unapplied_attributes(hid_t dataset, const std::string& path);

}  // namespace spoolflow::recording
