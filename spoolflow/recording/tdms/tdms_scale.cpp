#include "spoolflow/recording/tdms/tdms_scale.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace spoolflow::recording {
namespace {

constexpr std::size_t most_scales = 64;
constexpr std::size_t most_coefficients = 4096;

/// A number of the property that counts something; nothing where it is none.
std::optional<std::size_t> count_of(const TdmsProperties& properties, const std::string& name, std::size_t most) {
  const double* const value = properties.number(name);
  if (value == nullptr || !(*value >= 0) || *value > static_cast<double>(most)) return std::nullopt;
  return static_cast<std::size_t>(*value);
}

std::optional<std::size_t> scales_of(const TdmsProperties& properties) {
  if (properties.number("NI_Number_Of_Scales") != nullptr) {
    return count_of(properties, "NI_Number_Of_Scales", most_scales);
  }
  for (std::size_t k = most_scales; k-- > 0;) {
    if (properties.text(fmt::format("NI_Scale[{}]_Scale_Type", k)) != nullptr) return k + 1;
  }
  return 0;
}

/// Numbers called stem[0], stem[1] and so on; empty where one is missing or not finite.
std::vector<double> numbers_of(const TdmsProperties& properties, const std::string& stem, std::size_t count) {
  std::vector<double> out;
  for (std::size_t k = 0; k < count; ++k) {
    const double* const value = properties.number(fmt::format("{}[{}]", stem, k));
    if (value == nullptr || !std::isfinite(*value)) return {};
    out.push_back(*value);
  }
  return out;
}

/// Empty where the scale makes no sense.
TdmsPolynomial linear(const TdmsProperties& properties, const std::string& scale) {
  const double* const slope = properties.number(scale + "_Linear_Slope");
  const double* const intercept = properties.number(scale + "_Linear_Y_Intercept");
  if (slope == nullptr || intercept == nullptr || !std::isfinite(*slope) || !std::isfinite(*intercept)) return {};
  return {{*intercept, *slope}};
}

TdmsPolynomial polynomial(const TdmsProperties& properties, const std::string& scale) {
  const std::string size = scale + "_Polynomial_Coefficients_Size";
  const auto count = properties.number(size) == nullptr ? 4 : count_of(properties, size, most_coefficients);
  return {numbers_of(properties, scale + "_Polynomial_Coefficients", count.value_or(0))};
}

TdmsCurve curve(const TdmsProperties& properties, const std::string& scale) {
  const auto raw_count = count_of(properties, scale + "_Table_Pre_Scaled_Values_Size", most_coefficients);
  const auto count = count_of(properties, scale + "_Table_Scaled_Values_Size", most_coefficients);
  if (!count || raw_count != count) return {};
  const std::vector<double> raw = numbers_of(properties, scale + "_Table_Pre_Scaled_Values", *count);
  const std::vector<double> scaled = numbers_of(properties, scale + "_Table_Scaled_Values", *count);
  TdmsCurve out;
  for (std::size_t k = 0; k < std::min(raw.size(), scaled.size()); ++k) out.points.emplace_back(raw[k], scaled[k]);
  if (out.points.size() > 1 && out.points.front().first > out.points.back().first) std::ranges::reverse(out.points);
  for (std::size_t k = 1; k < out.points.size(); ++k) {
    if (out.points[k].first <= out.points[k - 1].first) return {};
  }
  return out;
}

double value_at(const TdmsPolynomial& scale, double raw) {
  double out = 0;
  for (std::size_t k = scale.coefficients.size(); k-- > 0;) out = out * raw + scale.coefficients[k];
  return out;
}

double value_at(const TdmsCurve& scale, double raw) {
  if (std::isnan(raw)) return raw;
  const auto above = std::ranges::lower_bound(scale.points, raw, {}, &std::pair<double, double>::first);
  if (above == scale.points.begin()) return above->second;
  if (above == scale.points.end()) return scale.points.back().second;
  const auto below = std::prev(above);
  return below->second + (above->second - below->second) * (raw - below->first) / (above->first - below->first);
}

}  // namespace

TdmsScale::TdmsScale(const TdmsProperties& channel, const TdmsProperties& group, const TdmsProperties& file) {
  for (const TdmsProperties* const properties : {&channel, &group, &file}) {
    if (scales_of(*properties) == std::size_t{0}) continue;
    read(*properties);
    return;
  }
}

void TdmsScale::read(const TdmsProperties& properties) {
  const std::string* const status = properties.text("NI_Scaling_Status");
  if (status != nullptr && *status == "scaled") return;
  const auto count = scales_of(properties);
  if (!count) {
    unread_ = "an impossible number of scales";
    return;
  }
  std::optional<std::size_t> next = *count - 1;
  while (next && steps_.size() <= *count) next = add(properties, *next);
  if (next) unread_ = "scales that lead round in a circle";
  if (!unread_.empty()) steps_.clear();
  std::ranges::reverse(steps_);
}

/// Adds the scale of that number; the one whose result it takes, or nothing where that is the raw number.
std::optional<std::size_t> TdmsScale::add(const TdmsProperties& properties, std::size_t index) {
  constexpr double raw_source = 4294967295.0;
  const std::string scale = fmt::format("NI_Scale[{}]", index);
  const std::string* const type = properties.text(scale + "_Scale_Type");
  if (type == nullptr) return std::nullopt;  // of DAQmx: the raw number itself
  const bool stays = *type == "AdvancedAPI";
  if (*type == "Linear" || *type == "Polynomial") {
    TdmsPolynomial step = *type == "Linear" ? linear(properties, scale) : polynomial(properties, scale);
    if (step.coefficients.empty()) unread_ = fmt::format("a scale '{}' whose coefficients are missing", *type);
    steps_.emplace_back(std::move(step));
  } else if (*type == "Table") {
    TdmsCurve step = curve(properties, scale);
    if (step.points.empty()) unread_ = "a scale 'Table' whose points are missing or do not rise";
    steps_.emplace_back(std::move(step));
  } else if (!stays) {
    unread_ = fmt::format("a scale '{}'", *type);
  }
  if (!unread_.empty()) return std::nullopt;
  const double* const source = properties.number(fmt::format("{}_{}_Input_Source", scale, *type));
  if (source == nullptr || *source == raw_source) return std::nullopt;
  if (!(*source >= 0) || *source >= static_cast<double>(most_scales)) {
    unread_ = "a scale of a scale that is not there";
    return std::nullopt;
  }
  if (stays) steps_.emplace_back(TdmsPolynomial{{0, 1}});
  return static_cast<std::size_t>(*source);
}

void TdmsScale::apply(double* values, std::size_t count) const {
  for (const auto& step : steps_) {
    std::visit(
        [&](const auto& scale) {
          for (std::size_t k = 0; k < count; ++k) values[k] = value_at(scale, values[k]);
        },
        step);
  }
}

}  // namespace spoolflow::recording
