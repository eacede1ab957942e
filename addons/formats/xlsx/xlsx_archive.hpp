#pragma once
/// The zip archive that an Excel workbook is, part by part, within bounds.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace spoolflow::recording {

/// "...: why; ...".
[[noreturn]] void refuse_xlsx(const std::string& what, const std::string& why);

class XlsxArchive {
 public:
  /// Opens the file and reads its list of parts. Throws RecordingError where it is no zip archive.
  explicit XlsxArchive(const std::filesystem::path& file);
  ~XlsxArchive();
  XlsxArchive(const XlsxArchive&) = delete;
  XlsxArchive& operator=(const XlsxArchive&) = delete;

  /// As the user named it.
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  /// "/xl/workbook.xml" and "xl/workbook.xml" are the same; so are capital and small letters.
  [[nodiscard]] bool has(const std::string& part) const;

  /// One part, unpacked as it is read. The archive must outlive it.
  class Part {
   public:
    ~Part();
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;
    /// Up to `out.size()` bytes; 0 at the end. Throws RecordingError where it is damaged, or where all that was
    /// unpacked of the archive so far is more than 16 MiB and 200 times the file.
    std::size_t read(std::span<char> out);
    /// "run.xlsx, xl/workbook.xml", for messages.
    [[nodiscard]] const std::string& what() const { return what_; }

   private:
    friend class XlsxArchive;
    Part(XlsxArchive& archive, const std::string& name);
    struct Stream;
    XlsxArchive& archive_;
    std::string what_;
    std::unique_ptr<Stream> stream_;
  };
  /// Throws RecordingError where there is none of that name, or a password protects it.
  [[nodiscard]] Part part(const std::string& name) { return {*this, name}; }

 private:
  struct Zip;
  [[nodiscard]] std::int64_t index_of(const std::string& part) const;
  std::string name_;
  std::uint64_t bytes_ = 0;
  std::uint64_t unpacked_ = 0;
  std::unique_ptr<Zip> zip_;
};

}  // namespace spoolflow::recording
