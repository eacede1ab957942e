#include "addons/formats/xlsx/xlsx_archive.hpp"

#include <zip.h>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {

void refuse_xlsx(const std::string& what, const std::string& why) {
  throw RecordingError(fmt::format("{}: {}; it is damaged, copy it again, or save it again", what, why));
}

struct XlsxArchive::Zip {
  zip_t* archive = nullptr;
  ~Zip() {
    if (archive != nullptr) zip_discard(archive);
  }
};

struct XlsxArchive::Part::Stream {
  zip_file_t* file = nullptr;
  ~Stream() {
    if (file != nullptr) (void)zip_fclose(file);
  }
};

XlsxArchive::XlsxArchive(const std::filesystem::path& file) : name_(file.string()), zip_(std::make_unique<Zip>()) {
  std::error_code failure;
  bytes_ = std::filesystem::file_size(file, failure);
  int error = 0;
  zip_->archive = failure ? nullptr : zip_open(file.c_str(), ZIP_RDONLY, &error);
  if (zip_->archive != nullptr) return;
  if (failure || error == ZIP_ER_OPEN || error == ZIP_ER_NOENT) {
    throw RecordingError(fmt::format("{}: cannot be opened; check the name and the permissions", name_));
  }
  if (error == ZIP_ER_MEMORY) throw std::bad_alloc();
  throw RecordingError(
      fmt::format("{}: begins as a zip archive (an Excel workbook is one), but its list of parts cannot be read: it is "
                  "cut short or damaged; copy it again",
                  name_));
}

XlsxArchive::~XlsxArchive() = default;

std::int64_t XlsxArchive::index_of(const std::string& part) const {
  const char* const name = part.c_str() + (part.starts_with('/') ? 1 : 0);
  return zip_name_locate(zip_->archive, name, ZIP_FL_NOCASE);
}

bool XlsxArchive::has(const std::string& part) const {
  return index_of(part) >= 0;
}

XlsxArchive::Part::Part(XlsxArchive& archive, const std::string& name)
    : archive_(archive), what_(archive.name_ + ", " + name), stream_(std::make_unique<Stream>()) {
  const std::int64_t index = archive.index_of(name);
  if (index < 0) refuse_xlsx(archive.name_, fmt::format("lacks its part {}", name));
  zip_t* const zip = archive.zip_->archive;
  stream_->file = zip_fopen_index(zip, static_cast<zip_uint64_t>(index), 0);
  if (stream_->file != nullptr) return;
  const int error = zip_error_code_zip(zip_get_error(zip));
  if (error == ZIP_ER_NOPASSWD || error == ZIP_ER_WRONGPASSWD) {
    throw RecordingError(fmt::format("{}: is protected by a password; save it without one", archive.name_));
  }
  if (error == ZIP_ER_MEMORY) throw std::bad_alloc();
  refuse_xlsx(what_, fmt::format("cannot be unpacked ({})", zip_error_strerror(zip_get_error(zip))));
}

XlsxArchive::Part::~Part() = default;

std::size_t XlsxArchive::Part::read(std::span<char> out) {
  constexpr std::uint64_t always = std::uint64_t{16} << 20U, times = 200;
  const zip_int64_t got = zip_fread(stream_->file, out.data(), out.size());
  if (got < 0) {
    refuse_xlsx(what_, fmt::format("cannot be unpacked ({})", zip_error_strerror(zip_file_get_error(stream_->file))));
  }
  archive_.unpacked_ += static_cast<std::uint64_t>(got);
  if (archive_.unpacked_ > always + times * archive_.bytes_) {
    throw RecordingError(
        fmt::format("{}: unpacks to more than {} MiB and {} times its size, which no recording does: it is damaged or "
                    "hostile; save it again, or as CSV",
                    what_, always >> 20U, times));
  }
  return static_cast<std::size_t>(got);
}

}  // namespace spoolflow::recording
