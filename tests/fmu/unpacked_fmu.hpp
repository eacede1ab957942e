#pragma once
/// An FMU's file, unpacked into a temporary folder that goes with the object.
#include <filesystem>
#include <string>
#include <vector>

#include "spoolflow/export/fmu_content.hpp"
#include "spoolflow/model/model.hpp"
#include "tests/fmu/xml_elements.hpp"

namespace spoolflow::exports {

class UnpackedFmu {
 public:
  explicit UnpackedFmu(const std::string& bytes);
  /// The same with another modelDescription.xml.
  UnpackedFmu(const std::string& bytes, const std::string& description);
  ~UnpackedFmu();
  UnpackedFmu(const UnpackedFmu&) = delete;
  UnpackedFmu& operator=(const UnpackedFmu&) = delete;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::string content(const std::string& name) const;
  void write(const std::string& name, const std::string& bytes) const;
  [[nodiscard]] std::vector<std::string> files() const;

  [[nodiscard]] const std::vector<XmlElement>& description() const { return description_; }
  [[nodiscard]] FmiVersion version() const;
  [[nodiscard]] std::string token() const;
  /// Elements that describe variables, whichever way the version does; FMI 2.0's typed element is merged in as "type".
  [[nodiscard]] const std::vector<XmlElement>& variables() const { return variables_; }
  /// Throws std::out_of_range for an unknown name.
  [[nodiscard]] unsigned reference(const std::string& variable) const;
  /// Path of the shared library for this machine.
  [[nodiscard]] std::filesystem::path library() const;

 private:
  std::filesystem::path folder_;
  std::vector<XmlElement> description_;
  std::vector<XmlElement> variables_;
  std::map<std::string, unsigned> references_;
};

/// The model that calibration makes of examples/valve_a.
[[nodiscard]] std::string sensor_fmu_of_example(FmiVersion version);
/// A whole valve that is the example's valve in both directions.
[[nodiscard]] model::Model whole_example();

}  // namespace spoolflow::exports
