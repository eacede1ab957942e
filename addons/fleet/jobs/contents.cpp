#include "addons/fleet/jobs/contents.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <zstd.h>

#include <fmt/format.h>

#include "addons/fleet/store/job_table.hpp"
#include "spoolflow/model/provenance.hpp"

namespace spoolflow::fleet {
namespace {

constexpr std::size_t chunk_bytes = 1'000'000;
constexpr int chunk_level = 3;  // about as quick as the server takes it

}  // namespace

std::vector<std::uint8_t> packed(std::string_view content, int level) {
  std::vector<std::uint8_t> out(ZSTD_compressBound(content.size()));
  out.resize(ZSTD_compress(out.data(), out.size(), content.data(), content.size(), level));
  return out;
}

PieceFile keep(Session& session, const std::string& name, const std::string& content) {
  PieceFile out{name, model::sha256_of_text(content), static_cast<std::int64_t>(content.size())};
  if (has_content(session, out.sha256)) return out;
  keep_content(session, out.sha256, out.bytes, [&](int place) -> std::optional<std::vector<std::uint8_t>> {
    const std::size_t from = chunk_bytes * static_cast<std::size_t>(place);
    if (from >= content.size()) return std::nullopt;
    return packed(std::string_view(content).substr(from, chunk_bytes), chunk_level);
  });
  return out;
}

std::string content_of(Session& session, const PieceFile& file) {
  std::string out;
  bool whole = true;
  const bool there = read_content(session, file.sha256, [&](const std::vector<std::uint8_t>& chunk) {
    const std::size_t before = out.size();
    out.resize(before + chunk_bytes);
    const std::size_t got = ZSTD_decompress(out.data() + before, chunk_bytes, chunk.data(), chunk.size());
    whole = whole && ZSTD_isError(got) == 0;
    out.resize(before + (whole ? got : 0));
  });
  if (!there || !whole || model::sha256_of_text(out) != file.sha256) {
    throw PieceError(fmt::format("{}: the fleet {} content {:.8}…; ask for the work again", file.name,
                                 there ? "has damaged" : "does not keep", file.sha256));
  }
  return out;
}

std::string whole_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  if (in) out << in.rdbuf();
  if (!in || (out.str().empty() && std::filesystem::file_size(file) > 0))
    throw std::runtime_error(fmt::format("{}: cannot be read", file.string()));
  return std::move(out).str();
}

}  // namespace spoolflow::fleet
