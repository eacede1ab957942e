#include "addons/fleet/pieces/piece_kinds.hpp"

#include <fstream>
#include <map>
#include <new>
#include <stdexcept>

#include <fmt/format.h>

#include "addons/fleet/jobs/contents.hpp"
#include "addons/fleet/jobs/job_worker.hpp"

namespace spoolflow::apps {
namespace {

std::map<std::string, PieceWork>& kinds() {
  static std::map<std::string, PieceWork> all;
  return all;
}

fleet::Outcome failure(int status, const std::string& message) {
  return {.status = status, .messages = {message}};
}

/// As the command's main() reports failures from unusable inputs.
fleet::Outcome outcome_of_piece() {
  try {
    const fleet::Piece piece = fleet::read_piece(fleet::whole_file(fleet::piece_name));
    const auto kind = kinds().find(piece.kind);
    if (kind == kinds().end()) return failure(1, fmt::format("there are no pieces of the kind '{}'", piece.kind));
    return kind->second(piece);
  } catch (const std::invalid_argument& error) {
    return failure(2, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return failure(2, fmt::format("{}: {}", error.path1().string(), error.code().message()));
  } catch (const std::bad_alloc&) {
    return failure(1, "out of memory; try a shorter recording or a worker with more");
  } catch (const std::exception& error) {
    return failure(1, error.what());
  }
}

}  // namespace

void add_piece_kind(const std::string& kind, PieceWork work) {
  kinds()[kind] = std::move(work);
}

void write_piece_file(const std::filesystem::path& file, const std::string& content) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out << content;
  out.close();
  if (!out) throw std::runtime_error(fmt::format("{}: cannot be written; is the disk full?", file.string()));
}

void do_piece_here() {
  const std::string text = fleet::text_of(outcome_of_piece());
  const std::string unfinished = std::string(fleet::outcome_name) + ".unfinished";
  write_piece_file(unfinished, text);
  std::filesystem::rename(unfinished, fleet::outcome_name);
}

}  // namespace spoolflow::apps
