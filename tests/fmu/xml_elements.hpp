#pragma once
/// Just enough XML for what the exporter writes: elements with their attributes, in the order of the file.
#include <map>
#include <string>
#include <vector>

namespace spoolflow::exports {

struct XmlElement {
  std::string name;
  std::string path;  ///< names of all elements around it and its own, joined by '/'
  std::map<std::string, std::string> attributes;

  [[nodiscard]] bool has(const std::string& attribute) const { return attributes.contains(attribute); }
  /// Throws std::out_of_range.
  [[nodiscard]] const std::string& operator[](const std::string& attribute) const { return attributes.at(attribute); }
};

/// Throws std::runtime_error where tags do not match or an attribute comes twice.
[[nodiscard]] std::vector<XmlElement> xml_elements(const std::string& text);

}  // namespace spoolflow::exports
