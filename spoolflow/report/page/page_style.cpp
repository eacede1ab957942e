#include "spoolflow/report/page/page_style.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "spoolflow/report/page/page_files.hpp"

namespace spoolflow::report {
namespace {

std::string_view bytes_of(std::string_view name) {
  const auto files = page_files();
  const auto found =
      std::find_if(files.begin(), files.end(), [&](const EmbeddedFile& file) { return file.name == name; });
  if (found == files.end()) throw std::logic_error("the program was built without " + std::string(name));
  return found->bytes;
}

}  // namespace

std::string_view page_style() {
  return bytes_of("page.css");
}

std::string_view page_script() {
  return bytes_of("page.js");
}

}  // namespace spoolflow::report
