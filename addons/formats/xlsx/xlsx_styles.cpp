#include "addons/formats/xlsx/xlsx_styles.hpp"

#include <cctype>
#include <map>

#include "addons/formats/xlsx/xml_events.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t most_styles = 100000;

/// Formats that files only number (18.8.30); 27 to 36 and 50 to 58 are dates of East Asia.
XlsxShown shown_by_built_in(std::uint64_t number) {
  if (number == 9 || number == 10) return XlsxShown::percent;
  const bool time = (number >= 14 && number <= 22) || (number >= 27 && number <= 36) ||
                    (number >= 45 && number <= 47) || (number >= 50 && number <= 58);
  return time ? XlsxShown::time : XlsxShown::number;
}

class StylesListener final : public XmlListener {
 public:
  explicit StylesListener(std::vector<XlsxShown>& out) : out_(out) {}
  void begin(std::string_view element, const XmlAttributes& attributes) override {
    if (element == "cellXfs") in_cells_ = true;
    if (element == "numFmt" && own_.size() < most_styles) {
      own_[attributes.whole("numFmtId", 0)] = shown_by(attributes.get("formatCode"));
    }
    if (element != "xf" || !in_cells_ || out_.size() == most_styles) return;
    const std::uint64_t number = attributes.whole("numFmtId", 0);
    const auto own = own_.find(number);
    out_.push_back(own != own_.end() ? own->second : shown_by_built_in(number));
  }
  void end(std::string_view element) override {
    if (element == "cellXfs") in_cells_ = false;
  }

 private:
  std::vector<XlsxShown>& out_;
  std::map<std::uint64_t, XlsxShown> own_;  ///< formats of this workbook; they stand before the styles
  bool in_cells_ = false;
};

/// [h], [mm], [ss]: hours, minutes, seconds beyond a day. [Red], [>100], [$-407] are none.
bool is_elapsed(std::string_view bracketed) {
  return !bracketed.empty() && bracketed.find_first_not_of("hmsHMS") == std::string_view::npos;
}

}  // namespace

XlsxShown shown_by(std::string_view format) {
  XlsxShown out = XlsxShown::number;
  for (std::size_t k = 0; k < format.size(); ++k) {
    const char c = format[k];
    if (c == ';') break;  // what follows is for negative numbers
    if (c == '\\' || c == '_' || c == '*') {
      ++k;
    } else if (c == '"') {
      k = std::min(format.find('"', k + 1), format.size());
    } else if (c == '[') {
      const std::size_t close = std::min(format.find(']', k), format.size());
      if (is_elapsed(format.substr(k + 1, close - k - 1))) return XlsxShown::time;
      k = close;
    } else if (format.substr(k, 7) == "General") {
      k += 6;
    } else if (std::string_view("ymdhs").find(static_cast<char>(std::tolower(static_cast<unsigned char>(c)))) !=
               std::string_view::npos) {
      return XlsxShown::time;
    } else if (c == '%') {
      out = XlsxShown::percent;
    }
  }
  return out;
}

XlsxStyles::XlsxStyles(XlsxArchive& archive, const std::string& part) {
  if (part.empty() || !archive.has(part)) return;
  StylesListener listener(shown_);
  read_xml(archive.part(part), listener);
}

}  // namespace spoolflow::recording
