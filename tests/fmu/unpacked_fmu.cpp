#include "tests/fmu/unpacked_fmu.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <zip.h>

#include "spoolflow/export/sensor_fmu.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::exports {
namespace fs = std::filesystem;

namespace {

void unpack(const std::string& bytes, const fs::path& folder) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  zip_t* archive = source == nullptr ? nullptr : zip_open_from_source(source, ZIP_CHECKCONS, &error);
  if (archive == nullptr) throw std::runtime_error(zip_error_strerror(&error));
  for (zip_int64_t k = 0; k < zip_get_num_entries(archive, 0); ++k) {
    zip_stat_t about{};
    zip_stat_index(archive, static_cast<zip_uint64_t>(k), 0, &about);
    std::string content(about.size, '\0');
    zip_file_t* file = zip_fopen_index(archive, static_cast<zip_uint64_t>(k), 0);
    if (zip_fread(file, content.data(), content.size()) != static_cast<zip_int64_t>(content.size())) {
      throw std::runtime_error(std::string("cannot read ") + about.name);
    }
    zip_fclose(file);
    fs::create_directories((folder / about.name).parent_path());
    std::ofstream(folder / about.name, std::ios::binary) << content;
  }
  zip_discard(archive);
}

std::vector<XmlElement> variables_of(const std::vector<XmlElement>& description) {
  std::vector<XmlElement> out;
  for (const XmlElement& element : description) {
    if (element.path.ends_with("/ScalarVariable/" + element.name)) {
      out.back().attributes.insert(element.attributes.begin(), element.attributes.end());
      out.back().attributes["type"] = element.name;
    } else if (element.path == "fmiModelDescription/ModelVariables/" + element.name) {
      out.push_back(element);
      if (element.name != "ScalarVariable") out.back().attributes["type"] = element.name;
    }
  }
  return out;
}

}  // namespace

UnpackedFmu::UnpackedFmu(const std::string& bytes) {
  std::string name = (fs::temp_directory_path() / "spoolflow fmu %-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = name;
  unpack(bytes, folder_);
  description_ = xml_elements(content("modelDescription.xml"));
  variables_ = variables_of(description_);
  for (const XmlElement& each : variables_) {
    references_[each["name"]] = static_cast<unsigned>(std::stoul(each["valueReference"]));
  }
}

UnpackedFmu::UnpackedFmu(const std::string& bytes, const std::string& description) : UnpackedFmu(bytes) {
  description_ = xml_elements(description);
  variables_ = variables_of(description_);
}

UnpackedFmu::~UnpackedFmu() {
  std::error_code gone;
  fs::remove_all(folder_, gone);
}

std::string UnpackedFmu::content(const std::string& name) const {
  std::ifstream in(folder_ / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void UnpackedFmu::write(const std::string& name, const std::string& bytes) const {
  std::ofstream(folder_ / name, std::ios::binary) << bytes;
}

std::vector<std::string> UnpackedFmu::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
    if (entry.is_regular_file()) names.push_back(fs::relative(entry.path(), folder_).generic_string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

FmiVersion UnpackedFmu::version() const {
  return description_.front()["fmiVersion"] == "2.0" ? FmiVersion::fmi2 : FmiVersion::fmi3;
}

std::string UnpackedFmu::token() const {
  return description_.front()[version() == FmiVersion::fmi2 ? "guid" : "instantiationToken"];
}

unsigned UnpackedFmu::reference(const std::string& variable) const {
  return references_.at(variable);
}

fs::path UnpackedFmu::library() const {
  const std::string identifier = description_.at(1)["modelIdentifier"];
  return folder_ / "binaries" / (version() == FmiVersion::fmi2 ? "linux64" : "x86_64-linux") / (identifier + ".so");
}

model::Model whole_example() {
  model::Model model = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
  model.p_to_a = model::Direction{model.condensed, model.observer, model.evidence};
  model.valve.direction = "both";
  return model;
}

std::string sensor_fmu_of_example(FmiVersion version) {
  return sensor_fmu(model::read_model(SPOOLFLOW_EXAMPLE_MODEL), version, "0.1.0");
}

}  // namespace spoolflow::exports
