#include "addons/formats/xlsx/xml_events.hpp"

#include <charconv>
#include <exception>
#include <expat.h>
#include <memory>
#include <new>
#include <vector>

#include <fmt/format.h>

namespace spoolflow::recording {
namespace {

constexpr std::size_t bytes_at_once = std::size_t{1} << 16U;
constexpr int deepest = 64;  // a workbook's parts have a tenth of it

std::string_view without_prefix(const char* name) {
  const std::string_view whole(name);
  return whole.substr(whole.find(':') + 1);  // npos + 1 is 0
}

struct FreeParser {
  void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
};

/// What expat calls. Nothing may be thrown through it: it is kept until expat has returned.
struct Calls {
  XmlListener& listener;
  const std::string& what;
  XML_Parser parser;
  std::exception_ptr thrown{};
  int depth = 0;

  template <class Work>
  void guarded(Work&& work) {
    if (thrown) return;
    try {
      work();
    } catch (...) {
      thrown = std::current_exception();
      (void)XML_StopParser(parser, XML_FALSE);
    }
  }
  static Calls& of(void* data) { return *static_cast<Calls*>(data); }
  static void begin(void* data, const char* name, const char** attributes) {
    Calls& calls = of(data);
    calls.guarded([&] {
      if (++calls.depth > deepest) refuse_xlsx(calls.what, fmt::format("elements {} levels deep", deepest));
      calls.listener.begin(without_prefix(name), XmlAttributes(attributes));
    });
  }
  static void end(void* data, const char* name) {
    Calls& calls = of(data);
    calls.guarded([&] {
      --calls.depth;
      calls.listener.end(without_prefix(name));
    });
  }
  static void text(void* data, const char* text, int bytes) {
    Calls& calls = of(data);
    calls.guarded([&] { calls.listener.text({text, static_cast<std::size_t>(bytes)}); });
  }
  static void document_type(void* data, const char*, const char*, const char*, int) {
    Calls& calls = of(data);
    calls.guarded([&] { refuse_xlsx(calls.what, "it has a document type, which no workbook has"); });
  }
};

// Newer versions deprecate it for XML_GetCurrentLineNumber64, which older ones do not have.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
std::uint64_t current_line(XML_Parser parser) {
  return XML_GetCurrentLineNumber(parser);
}
#pragma GCC diagnostic pop

}  // namespace

std::string_view XmlAttributes::get(std::string_view name) const {
  for (const char** pair = pairs_; *pair != nullptr; pair += 2) {
    if (without_prefix(*pair) == name) return pair[1];
  }
  return {};
}

std::uint64_t XmlAttributes::whole(std::string_view name, std::uint64_t otherwise) const {
  const std::string_view text = get(name);
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? value : otherwise;
}

bool XmlAttributes::flag(std::string_view name) const {
  const std::string_view text = get(name);
  return text == "1" || text == "true" || text == "on";
}

void read_xml(XlsxArchive::Part part, XmlListener& listener) {
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, FreeParser> parser(XML_ParserCreate(nullptr));
  if (!parser) throw std::bad_alloc();
  Calls calls{listener, part.what(), parser.get()};
  XML_SetUserData(parser.get(), &calls);
  XML_SetElementHandler(parser.get(), Calls::begin, Calls::end);
  XML_SetCharacterDataHandler(parser.get(), Calls::text);
  XML_SetStartDoctypeDeclHandler(parser.get(), Calls::document_type);
  std::vector<char> bytes(bytes_at_once);
  for (bool last = false; !last && !listener.has_enough();) {
    const std::size_t got = part.read(bytes);
    last = got == 0;
    const auto status = XML_Parse(parser.get(), bytes.data(), static_cast<int>(got), last ? 1 : 0);
    if (calls.thrown) std::rethrow_exception(calls.thrown);
    if (status != XML_STATUS_ERROR) continue;
    const XML_Error error = XML_GetErrorCode(parser.get());
    if (error == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
    refuse_xlsx(part.what(),
                fmt::format("is no XML: {} in line {}", XML_ErrorString(error), current_line(parser.get())));
  }
}

}  // namespace spoolflow::recording
