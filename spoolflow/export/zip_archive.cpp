#include "spoolflow/export/zip_archive.hpp"

#include <memory>
#include <stdexcept>
#include <zip.h>

namespace spoolflow::exports {
namespace {

struct FreeSource {
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};
struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Source = std::unique_ptr<zip_source_t, FreeSource>;
using Archive = std::unique_ptr<zip_t, Discard>;

[[noreturn]] void fail(const std::string& what, zip_error_t* error) {
  throw std::runtime_error("the archive cannot be made: " + what + ": " +
                           (error == nullptr ? "out of memory" : zip_error_strerror(error)));
}

void add(zip_t* archive, const ArchiveMember& member, std::time_t time) {
  Source content(zip_source_buffer(archive, member.bytes.data(), member.bytes.size(), 0));
  if (!content) fail(member.name, zip_get_error(archive));
  const zip_int64_t index = zip_file_add(archive, member.name.c_str(), content.get(), ZIP_FL_ENC_UTF_8);
  if (index < 0) fail(member.name, zip_get_error(archive));
  (void)content.release();  // the archive owns it now
  const auto at = static_cast<zip_uint64_t>(index);
  if (zip_set_file_compression(archive, at, ZIP_CM_DEFLATE, 6) != 0 || zip_file_set_mtime(archive, at, time, 0) != 0) {
    fail(member.name, zip_get_error(archive));
  }
}

std::string content_of(zip_source_t* source) {
  zip_stat_t about{};
  if (zip_source_stat(source, &about) != 0 || zip_source_open(source) != 0) fail("reading", zip_source_error(source));
  std::string bytes(about.size, '\0');
  const zip_int64_t got = zip_source_read(source, bytes.data(), bytes.size());
  zip_source_close(source);
  if (got != static_cast<zip_int64_t>(bytes.size())) fail("reading", zip_source_error(source));
  return bytes;
}

}  // namespace

std::string zip_archive(const std::vector<ArchiveMember>& members, std::time_t time) {
  zip_error_t error;
  zip_error_init(&error);
  Source memory(zip_source_buffer_create(nullptr, 0, 0, &error));
  if (!memory) fail("memory", &error);
  Archive archive(zip_open_from_source(memory.get(), ZIP_TRUNCATE, &error));
  if (!archive) fail("opening", &error);
  zip_source_keep(memory.get());  // the archive frees its own reference
  for (const ArchiveMember& member : members) add(archive.get(), member, time);
  if (zip_close(archive.get()) != 0) fail("writing", zip_get_error(archive.get()));
  (void)archive.release();  // closed
  return content_of(memory.get());
}

}  // namespace spoolflow::exports
