/// Excel workbooks as their reader takes them, in this process: the input as it is where it begins as a zip archive,
/// and else as the parts of one, whose checksums and lengths are right, so that what lies behind these is reached.
#include "addons/formats/tests/xlsx/xlsx_file.hpp"
#include "addons/formats/xlsx/xlsx_table.hpp"
#include "tests/fuzz/vector_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace spoolflow;
  static const fuzz::InputFile file("run.xlsx");
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  if (input.starts_with("PK")) {
    fuzz::read_vectors(file, data, size, recording::open_xlsx_table);
    return 0;
  }
  // Sheet, styles and shared texts, each ended by a zero byte.
  recording::XlsxFile workbook;
  std::string_view rest = input;
  const auto next = [&rest] {
    const std::size_t end = std::min(rest.find('\0'), rest.size());
    const std::string part(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return part;
  };
  const std::string sheet = next(), styles = next(), texts = next();
  workbook.sheet("Sheet1", sheet).styles_part(styles).texts_part(texts).stored();
  const std::string bytes = workbook.content();
  fuzz::read_vectors(file, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(),
                     recording::open_xlsx_table);
  return 0;
}
