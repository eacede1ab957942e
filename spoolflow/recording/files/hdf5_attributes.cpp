#include "spoolflow/recording/files/hdf5_attributes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/recording/files/hdf5_handle.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t longest_text = 4096;

}  // namespace

std::string text_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return {};
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) return {};
  const Hdf5Handle type(H5Aget_type(attribute.id()), H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute.id()), H5Sclose);
  if (!type.valid() || !space.valid() || H5Tget_class(type.id()) != H5T_STRING) return {};
  if (H5Sget_simple_extent_npoints(space.id()) != 1) return {};
  std::string out;
  if (H5Tis_variable_str(type.id()) > 0) {
    char* text = nullptr;
    if (H5Aread(attribute.id(), type.id(), &text) < 0 || text == nullptr) return {};
    out.assign(text, std::find(text, text + longest_text, '\0'));
    H5free_memory(text);
  } else {
    const std::size_t size = H5Tget_size(type.id());
    if (size == 0 || size > longest_text) return {};
    out.resize(size);
    if (H5Aread(attribute.id(), type.id(), out.data()) < 0) return {};
    out.resize(std::min(out.size(), out.find('\0')));
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

std::optional<double> optional_number_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return std::nullopt;
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) return std::nullopt;
  const Hdf5Handle space(H5Aget_space(attribute.id()), H5Sclose);
  double value = 0;
  if (!space.valid() || H5Sget_simple_extent_npoints(space.id()) != 1 ||
      H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value) < 0) {
    return std::nullopt;
  }
  return value;
}

double number_attribute(hid_t object, const char* name, double otherwise) {
  return optional_number_attribute(object, name).value_or(otherwise);
}

std::optional<ClockTime> start_attribute(hid_t object, const char* name) {
  if (const std::string text = text_attribute(object, name); !text.empty()) return read_clock_time(text);
  constexpr double most_s = 1e10;  // since 1970; more is in another unit
  const double second = number_attribute(object, name, 0.0);
  if (!(second > 0) || !(second < most_s)) return std::nullopt;
  return ClockTime{0, second};
}

std::optional<ClockTime> start_of_group(hid_t file, const std::string& path) {
  for (std::size_t end = path.rfind('/');; end = path.rfind('/', end - 1)) {
    const std::string group = end == std::string::npos || end == 0 ? "/" : path.substr(0, end);
    const Hdf5Handle object(H5Oopen(file, group.c_str(), H5P_DEFAULT), H5Oclose);
    if (!object.valid()) return std::nullopt;
    if (const auto start = start_attribute(object.id(), "start_time")) return start;
    if (group == "/") return std::nullopt;
  }
}

std::string unapplied_attributes(hid_t dataset, const std::string& path) {
  constexpr std::array factors{"gain", "scale", "sensitivity", "factor", "slope"};
  for (const char* const name : factors) {
    const auto value = optional_number_attribute(dataset, name);
    if (!value || *value == 1.0 || number_attribute(dataset, "scale_factor", *value + 1) == *value) continue;
    return fmt::format(
        "'{}' has the attribute {} = {:g}, which is not applied: if its numbers are still to be scaled by it, call it "
        "scale_factor, or give scale in a channel map",
        path, name, *value);
  }
  return {};
}

}  // namespace spoolflow::recording
