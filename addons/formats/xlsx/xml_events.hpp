#pragma once
/// A part of a workbook as XML: its elements one after the other, nothing of it kept.
#include <string_view>

#include "addons/formats/xlsx/xlsx_archive.hpp"

namespace spoolflow::recording {

/// Of one element, by their names without a prefix.
class XmlAttributes {
 public:
  explicit XmlAttributes(const char** pairs) : pairs_(pairs) {}
  /// Empty where there is none.
  [[nodiscard]] std::string_view get(std::string_view name) const;
  /// A whole number; `otherwise` where there is none, or none that fits.
  [[nodiscard]] std::uint64_t whole(std::string_view name, std::uint64_t otherwise) const;
  /// "1", "true", "on".
  [[nodiscard]] bool flag(std::string_view name) const;

 private:
  const char** pairs_;
};

/// Called for each element, by its name without a prefix; text may come in pieces.
class XmlListener {
 public:
  XmlListener() = default;
  XmlListener(const XmlListener&) = delete;
  XmlListener& operator=(const XmlListener&) = delete;
  virtual ~XmlListener() = default;
  virtual void begin(std::string_view element, const XmlAttributes& attributes) = 0;
  virtual void end(std::string_view element) = 0;
  virtual void text(std::string_view) {}
  /// Whether the rest need not be read.
  [[nodiscard]] virtual bool has_enough() const { return false; }
};

/// Reads the part to its end. Throws RecordingError where it is no XML, and of a document type, which no workbook has
/// and whose entities can be hostile; what the listener throws passes.
void read_xml(XlsxArchive::Part part, XmlListener& listener);

}  // namespace spoolflow::recording
