#include "spoolflow/model/json_node.hpp"

#include <cmath>

#include <fmt/format.h>

#include "spoolflow/model/model_error.hpp"

namespace spoolflow::model {
namespace {

/// No quantity of a model is larger in SI units; figures of larger ones are no figures any more.
constexpr double largest_number = 1e15;

std::string shown(const nlohmann::ordered_json& value) {
  std::string text = value.dump();
  if (text.size() > 40) text = text.substr(0, 37) + "...";
  return text;
}

}  // namespace

void JsonNode::refuse(const std::string& problem) const {
  throw ModelError(fmt::format("{}: {}: {}", file_, path_.empty() ? "/" : path_, problem));
}

bool JsonNode::has(const std::string& key) const {
  return value_.is_object() && value_.contains(key);
}

JsonNode JsonNode::at(const std::string& key) const {
  if (!value_.is_object())
    refuse(fmt::format("{} is no object; make the model again with `spoolflow calibrate`", shown(value_)));
  const auto found = value_.find(key);
  if (found == value_.end()) {
    refuse(fmt::format("\"{}\" is missing; make the model again with `spoolflow calibrate`", key));
  }
  return {*found, path_ + "/" + key, file_};
}

std::vector<JsonNode> JsonNode::elements() const {
  if (!value_.is_array()) refuse(fmt::format("{} is no array", shown(value_)));
  std::vector<JsonNode> out;
  out.reserve(value_.size());
  for (std::size_t k = 0; k < value_.size(); ++k) out.emplace_back(value_[k], fmt::format("{}/{}", path_, k), file_);
  return out;
}

std::string JsonNode::text() const {
  if (!value_.is_string()) refuse(fmt::format("{} is no text", shown(value_)));
  return value_.get<std::string>();
}

double JsonNode::number() const {
  if (!value_.is_number()) refuse(fmt::format("{} is no number", shown(value_)));
  const double number = value_.get<double>();
  if (!std::isfinite(number)) refuse("the number is not finite");
  if (std::abs(number) > largest_number) {
    refuse(fmt::format("{} is larger than any quantity of a valve, {}; make the model again with `spoolflow calibrate`",
                       shown(value_), largest_number));
  }
  return number;
}

double JsonNode::number(double lowest, double highest) const {
  const double found = number();
  if (!(found >= lowest && found <= highest)) {
    refuse(fmt::format("{} is outside {} to {}", shown(value_), lowest, highest));
  }
  return found;
}

std::vector<double> JsonNode::numbers() const {
  std::vector<double> out;
  for (const JsonNode& element : elements()) out.push_back(element.number());
  return out;
}

std::vector<double> JsonNode::rising_numbers() const {
  const std::vector<JsonNode> nodes = elements();
  std::vector<double> out;
  for (const JsonNode& node : nodes) {
    const double value = node.number();
    if (!out.empty() && !(value > out.back())) {
      node.refuse(fmt::format("{} does not rise above {} before it; axes rise from entry to entry", value, out.back()));
    }
    out.push_back(value);
  }
  return out;
}

}  // namespace spoolflow::model
