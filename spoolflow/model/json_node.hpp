#pragma once
/// A place in a model file: reads typed, validated values and names the JSON path when one is wrong.
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace spoolflow::model {

class JsonNode {
 public:
  JsonNode(const nlohmann::ordered_json& value, std::string path, const std::string& file)
      : value_(value), path_(std::move(path)), file_(file) {}

  /// The member `key`; throws where this is no object or has no such member.
  [[nodiscard]] JsonNode at(const std::string& key) const;
  [[nodiscard]] bool has(const std::string& key) const;
  [[nodiscard]] std::vector<JsonNode> elements() const;
  [[nodiscard]] std::string text() const;
  /// Finite and no larger than any quantity of a valve (1e15).
  [[nodiscard]] double number() const;
  [[nodiscard]] double number(double lowest, double highest) const;
  [[nodiscard]] std::vector<double> numbers() const;
  /// Numbers that rise from each to the next.
  [[nodiscard]] std::vector<double> rising_numbers() const;
  /// Throws ModelError: "FILE: PATH: problem".
  [[noreturn]] void refuse(const std::string& problem) const;

 private:
  const nlohmann::ordered_json& value_;
  std::string path_;
  const std::string& file_;
};

}  // namespace spoolflow::model
