#include "addons/formats/xlsx/xlsx_texts.hpp"

#include <fmt/format.h>

#include "addons/formats/xlsx/xml_events.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t most_bytes = std::size_t{64} << 20U;

/// Runs of one text with fonts of their own are one; how it is read aloud (rPh) is no part of it.
class TextsListener final : public XmlListener {
 public:
  TextsListener(const std::string& what, std::string& all, std::vector<std::size_t>& ends)
      : what_(what), all_(all), ends_(ends) {}
  void begin(std::string_view element, const XmlAttributes&) override {
    if (element == "rPh") in_phonetic_ = true;
    if (element == "t") in_text_ = !in_phonetic_;
  }
  void end(std::string_view element) override {
    if (element == "rPh") in_phonetic_ = false;
    if (element == "t") in_text_ = false;
    if (element != "si") return;
    ends_.push_back(all_.size());
    check();
  }
  void text(std::string_view text) override {
    if (!in_text_) return;
    all_ += text;
    check();
  }

 private:
  void check() const {
    if (all_.size() + ends_.size() * sizeof(std::size_t) <= most_bytes) return;
    refuse_xlsx(what_, fmt::format("more than {} MiB of texts", most_bytes >> 20U));
  }
  const std::string& what_;
  std::string& all_;
  std::vector<std::size_t>& ends_;
  bool in_text_ = false, in_phonetic_ = false;
};

}  // namespace

XlsxTexts::XlsxTexts(XlsxArchive& archive, const std::string& part) {
  if (part.empty() || !archive.has(part)) return;
  TextsListener listener(archive.name(), all_, ends_);
  read_xml(archive.part(part), listener);
}

}  // namespace spoolflow::recording
