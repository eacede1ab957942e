#include "tests/export/exported_folder.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sys/wait.h>

namespace spoolflow::exports {

namespace fs = std::filesystem;

model::Model example_model() {
  return model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
}

model::Model whole_example_model() {
  model::Model model = example_model();
  model.p_to_a = model::Direction{model.condensed, model.observer, model.evidence};
  model.valve.direction = "both";
  return model;
}

ExportedFolder::ExportedFolder(const model::Model& model) {
  std::string name = (fs::temp_directory_path() / "spoolflow-export-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = name;
  for (const ExportedFile& file : cpp_folder(model)) write(file.name, file.content);
}

ExportedFolder::~ExportedFolder() {
  fs::remove_all(folder_);
}

std::string ExportedFolder::content(const std::string& name) const {
  std::ifstream in(folder_ / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void ExportedFolder::write(const std::string& name, const std::string& content) const {
  fs::create_directories((folder_ / name).parent_path());
  std::ofstream(folder_ / name, std::ios::binary) << content;
}

int ExportedFolder::run(const std::string& command) const {
  const int status = std::system(("cd '" + folder_.string() + "' && { " + command + " ; } 1>&2").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace spoolflow::exports
