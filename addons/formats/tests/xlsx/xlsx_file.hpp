#pragma once
/// The smallest Excel workbooks, part by part in a zip archive that is written byte by byte.
#include <string>
#include <utility>
#include <vector>
#include <zlib.h>

#include "tests/recording/written_bytes.hpp"

namespace spoolflow::recording {

/// A zip archive of parts, deflated or as they are.
class ZipFile {
 public:
  struct How {
    bool deflated = true;
    bool damaged = false;  ///< the checksum is not that of the part
    std::uint16_t flags = 0;
  };
  void add(const std::string& name, const std::string& part) { add(name, part, How()); }
  void add(const std::string& name, const std::string& part, How how) {
    const std::string packed = how.deflated ? deflated(part) : part;
    auto sum = static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(part.data()), static_cast<uInt>(part.size())));
    if (how.damaged) sum ^= 1U;
    WrittenBytes head;
    head.u16(20).u16(how.flags).u16(how.deflated ? 8 : 0).u16(0).u16(0x5821).u32(sum);
    head.u32(static_cast<std::uint32_t>(packed.size())).u32(static_cast<std::uint32_t>(part.size()));
    head.u16(static_cast<std::uint16_t>(name.size())).u16(0);
    WrittenBytes entry;
    entry.raw("PK\1\2")
        .u16(20)
        .raw(head.content())
        .zeros(2 + 2 + 2 + 4)
        .u32(static_cast<std::uint32_t>(content_.size()));
    directory_ += entry.content() + name;
    content_ += "PK\3\4" + head.content() + name + packed;
    ++parts_;
  }
  [[nodiscard]] std::string content() const {
    WrittenBytes end;
    end.raw("PK\5\6").u32(0).u16(parts_).u16(parts_);
    end.u32(static_cast<std::uint32_t>(directory_.size())).u32(static_cast<std::uint32_t>(content_.size())).u16(0);
    return content_ + directory_ + end.content();
  }

 private:
  static std::string deflated(const std::string& part) {
    z_stream stream{};
    (void)deflateInit2(&stream, 9, Z_DEFLATED, -15, 9, Z_DEFAULT_STRATEGY);
    std::string out(deflateBound(&stream, static_cast<uLong>(part.size())), '\0');
    std::string in = part;
    stream.next_in = reinterpret_cast<Bytef*>(in.data());
    stream.avail_in = static_cast<uInt>(in.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    (void)deflate(&stream, Z_FINISH);
    out.resize(stream.total_out);
    (void)deflateEnd(&stream);
    return out;
  }
  std::string content_, directory_;
  std::uint16_t parts_ = 0;
};

class XlsxFile {
 public:
  /// `rows`: what stands in the element sheetData; or the whole part, where it begins with "<?".
  XlsxFile& sheet(const std::string& name, const std::string& rows, const std::string& more = "") {
    sheets_.push_back({name, rows, more});
    return *this;
  }
  /// <si> elements, or the whole part.
  XlsxFile& texts_part(const std::string& items) {
    texts_ = items;
    return *this;
  }
  /// Formats of numbers, one a style from 1 on.
  XlsxFile& formats(const std::vector<std::string>& formats) {
    std::string own, cells = "<xf numFmtId=\"0\"/>";
    for (std::size_t k = 0; k < formats.size(); ++k) {
      const std::string number = std::to_string(164 + k);
      own += "<numFmt numFmtId=\"" + number + "\" formatCode=\"" + formats[k] + "\"/>";
      cells += "<xf numFmtId=\"" + number + "\"/>";
    }
    return styles_part("<numFmts>" + own + "</numFmts><cellStyleXfs><xf numFmtId=\"14\"/></cellStyleXfs><cellXfs>" +
                       cells + "</cellXfs>");
  }
  XlsxFile& styles_part(const std::string& content) {
    styles_ = content;
    return *this;
  }
  XlsxFile& from_1904() {
    properties_ = "<workbookPr date1904=\"1\"/>";
    return *this;
  }
  XlsxFile& packed(ZipFile::How how) {
    how_ = how;
    return *this;
  }
  /// No part is deflated.
  XlsxFile& stored() {
    how_.deflated = others_.deflated = false;
    return *this;
  }
  [[nodiscard]] std::string content() const {
    constexpr const char* relations = "http://schemas.openxmlformats.org/officeDocument/2006/relationships/";
    const auto relationship = [&](const std::string& id, const std::string& kind, const std::string& target) {
      return "<Relationship Id=\"" + id + "\" Type=\"" + relations + kind + "\" Target=\"" + target + "\"/>";
    };
    ZipFile zip;
    zip.add("_rels/.rels", part("Relationships", relationship("rId1", "officeDocument", "xl/workbook.xml")), others_);
    std::string list, parts;
    for (std::size_t k = 0; k < sheets_.size(); ++k) {
      const std::string number = std::to_string(k + 1);
      list += "<sheet name=\"" + sheets_[k].name + "\" sheetId=\"" + number + "\" r:id=\"rId" + number + "\"" +
              sheets_[k].more + "/>";
      parts += relationship("rId" + number, "worksheet", "worksheets/sheet" + number + ".xml");
      zip.add("xl/worksheets/sheet" + number + ".xml",
              sheets_[k].rows.starts_with("<?")
                  ? sheets_[k].rows
                  : part("worksheet", "<dimension ref=\"A1\"/><sheetData>" + sheets_[k].rows + "</sheetData>"),
              how_);
    }
    parts += relationship("rId98", "sharedStrings", "/xl/sharedStrings.xml");
    parts += relationship("rId99", "styles", "../xl/styles.xml");
    zip.add("xl/workbook.xml",
            part("workbook xmlns:r=\"" + std::string(relations, 67) + "\"",
                 properties_ + "<sheets>" + list + "</sheets>", "workbook"),
            others_);
    zip.add("xl/_rels/workbook.xml.rels", part("Relationships", parts), others_);
    zip.add("xl/sharedStrings.xml", texts_.starts_with("<?") ? texts_ : part("sst", texts_), ZipFile::How{false});
    zip.add("xl/styles.xml", styles_.starts_with("<?") ? styles_ : part("styleSheet", styles_), others_);
    return zip.content();
  }

 private:
  struct Sheet {
    std::string name, rows, more;
  };
  static std::string part(const std::string& element, const std::string& content, const std::string& end = "") {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<" + element + ">" + content + "</" +
           (end.empty() ? element : end) + ">";
  }
  std::vector<Sheet> sheets_;
  std::string texts_, styles_, properties_;
  ZipFile::How how_;     ///< of sheets
  ZipFile::How others_;  ///< of the other parts
};

/// "<row><c>…": numbers, texts in quotes ("'name"), or a cell as it stands ("<c …").
inline std::string xlsx_row(const std::vector<std::string>& cells) {
  std::string out = "<row>";
  for (const std::string& cell : cells) {
    if (cell.empty()) {
      out += "<c/>";
    } else if (cell[0] == '<') {
      out += cell;
    } else if (cell[0] == '\'') {
      out += "<c t=\"inlineStr\"><is><t>" + cell.substr(1) + "</t></is></c>";
    } else {
      out += "<c><v>" + cell + "</v></c>";
    }
  }
  return out + "</row>";
}

}  // namespace spoolflow::recording
