#include "addons/formats/xlsx/xlsx_workbook.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "addons/formats/xlsx/xml_events.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t most_parts = 10000;

/// "xl/worksheets/sheet1.xml" from "worksheets/sheet1.xml" in "xl/workbook.xml"; without "." and "..".
std::string resolved(const std::string& target, const std::string& source) {
  const std::size_t folder = source.rfind('/');
  const bool whole = target.starts_with('/') || folder == std::string::npos;
  const std::string path = whole ? target : source.substr(0, folder + 1) + target;
  std::vector<std::string> names;
  for (std::size_t at = 0; at <= path.size();) {
    const std::size_t end = std::min(path.find('/', at), path.size());
    const std::string name = path.substr(at, end - at);
    if (name == ".." && !names.empty()) names.pop_back();
    if (!name.empty() && name != "." && name != "..") names.push_back(name);
    at = end + 1;
  }
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : "/") + name;
  return out;
}

struct Relationship {
  std::string kind;  ///< last part of its type: "worksheet"
  std::string part;
};

/// What a part refers to, by its name in there.
class Relationships final : public XmlListener {
 public:
  Relationships(XlsxArchive& archive, std::string source) : source_(std::move(source)) {
    const std::size_t folder = source_.rfind('/');
    const std::size_t leaf = folder == std::string::npos ? 0 : folder + 1;
    const std::string part = source_.substr(0, leaf) + "_rels/" + source_.substr(leaf) + ".rels";
    if (archive.has(part)) read_xml(archive.part(part), *this);
  }
  void begin(std::string_view element, const XmlAttributes& attributes) override {
    if (element != "Relationship" || attributes.get("TargetMode") == "External" || all_.size() == most_parts) return;
    const std::string_view type = attributes.get("Type");
    const std::string kind(type.substr(type.rfind('/') + 1));
    all_[std::string(attributes.get("Id"))] = {kind, resolved(std::string(attributes.get("Target")), source_)};
  }
  void end(std::string_view) override {}

  [[nodiscard]] const Relationship* named(const std::string& id) const {
    const auto found = all_.find(id);
    return found == all_.end() ? nullptr : &found->second;
  }
  /// The part of the first one of that kind; empty where there is none.
  [[nodiscard]] std::string of_kind(const std::string& kind) const {
    const auto found = std::ranges::find_if(all_, [&](const auto& each) { return each.second.kind == kind; });
    return found == all_.end() ? "" : found->second.part;
  }

 private:
  std::string source_;
  std::map<std::string, Relationship> all_;
};

class WorkbookListener final : public XmlListener {
 public:
  WorkbookListener(const Relationships& parts, XlsxWorkbook& out) : parts_(parts), out_(out) {}
  void begin(std::string_view element, const XmlAttributes& attributes) override {
    if (element == "workbookPr") out_.from_1904 = attributes.flag("date1904");
    if (element != "sheet" || out_.sheets.size() == most_parts) return;
    const std::string_view state = attributes.get("state");
    const Relationship* const part = parts_.named(std::string(attributes.get("id")));
    if (part == nullptr || part->kind != "worksheet") return;
    std::string name(attributes.get("name"));
    if (state.empty() || state == "visible") {
      out_.sheets.push_back({std::move(name), part->part});
    } else if (out_.hidden.size() < most_parts) {
      out_.hidden.push_back(std::move(name));
    }
  }
  void end(std::string_view) override {}

 private:
  const Relationships& parts_;
  XlsxWorkbook& out_;
};

[[noreturn]] void refuse_other(const XlsxArchive& archive) {
  std::string_view what = "a zip archive that holds no Excel workbook",
                   remedy = "unpack it and name the recording in it";
  if (archive.has("xl/workbook.bin")) {
    what = "a binary Excel workbook (.xlsb)", remedy = "save it as .xlsx, or the sheet as CSV";
  } else if (archive.has("META-INF/manifest.xml") && archive.has("content.xml")) {
    what = "an OpenDocument file", remedy = "save its sheet as .xlsx or CSV";
  } else if (archive.has("word/document.xml")) {
    what = "a Word document", remedy = "name the recording itself";
  } else if (archive.has("modelDescription.xml")) {
    what = "an FMU", remedy = "name a recording";
  }
  throw RecordingError(fmt::format("{}: is {}, which is not read here; {}", archive.name(), what, remedy));
}

}  // namespace

XlsxWorkbook read_xlsx_workbook(XlsxArchive& archive) {
  const std::string workbook = Relationships(archive, "").of_kind("officeDocument");
  if (workbook.empty() || !workbook.ends_with(".xml") || !archive.has(workbook)) refuse_other(archive);
  const Relationships parts(archive, workbook);
  XlsxWorkbook out;
  WorkbookListener listener(parts, out);
  read_xml(archive.part(workbook), listener);
  out.texts = parts.of_kind("sharedStrings");
  out.styles = parts.of_kind("styles");
  if (out.sheets.empty()) refuse_other(archive);
  return out;
}

}  // namespace spoolflow::recording
