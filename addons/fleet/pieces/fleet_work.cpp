#include "addons/fleet/pieces/fleet_work.hpp"

#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include "addons/fleet/jobs/contents.hpp"
#include "addons/fleet/settings.hpp"

namespace spoolflow::apps {

std::string SentPiece::here(std::string text) const {
  for (const auto& [there, name] : names) {
    for (std::size_t at = text.find(there); at != std::string::npos; at = text.find(there, at + name.size()))
      text.replace(at, there.size(), name);
  }
  return text;
}

FleetWork::FleetWork(const std::string& fleet_file, std::string_view version,
                     const std::function<void(const std::string&)>& report) {
  const fleet::FleetSettings settings = fleet::read_fleet(fleet_file);
  limits_ = settings.jobs;
  batch_ = std::make_unique<fleet::Batch>(settings.connection, fleet::piece_program(std::string(version)), report);
}

void FleetWork::place(SentPiece& piece, const std::string& name, const std::string& here, const std::string& content) {
  const double size_MB = 1e-6 * static_cast<double>(content.size());
  if (size_MB > limits_.largest_MB) throw std::invalid_argument(fleet::too_large(here, size_MB, limits_));
  piece.piece.files.push_back(batch_->keep(name, content));
  piece.names.emplace_back(name, here);
}

void FleetWork::add(SentPiece& piece, const std::string& file, const std::string& inside) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw std::invalid_argument(fmt::format("{}: is no file that could be sent to the fleet; name one", file));
  const std::string name =
      inside.empty() ? fmt::format("@{}@/{}", piece.piece.files.size(), std::filesystem::path(file).filename().string())
                     : "@0@/" + inside;
  place(piece, name, file, fleet::whole_file(file));
}

void FleetWork::add_text(SentPiece& piece, const std::string& name, const std::string& content) {
  place(piece, fmt::format("@{}@/{}", piece.piece.files.size(), name), name, content);
}

void FleetWork::add_kept(SentPiece& piece, const std::string& name, const fleet::PieceFile& file) {
  piece.piece.files.push_back({fmt::format("@{}@/{}", piece.piece.files.size(), name), file.sha256, file.bytes});
  piece.names.emplace_back(piece.piece.files.back().name, name);
}

std::size_t FleetWork::ask(SentPiece piece) {
  sent_.push_back(std::move(piece));
  return batch_->ask(sent_.back().piece);
}

void FleetWork::wait(const std::function<void(std::size_t, const fleet::Outcome&)>& finished) {
  batch_->wait([&](std::size_t number, fleet::Outcome outcome) {
    for (std::string& message : outcome.messages) message = sent_[number].here(std::move(message));
    finished(number, outcome);
  });
}

const std::string& path_of(const fleet::Piece& piece, std::size_t number) {
  if (number >= piece.files.size()) throw fleet::PieceError("a piece lacks a file that its kind needs");
  return piece.files[number].name;
}

void throw_failure(const fleet::Outcome& outcome) {
  if (outcome.status == 0) return;
  const std::string message = outcome.messages.empty() ? "a piece failed without a word" : outcome.messages.front();
  if (outcome.status == 2) throw std::invalid_argument(message);
  throw std::runtime_error(message);
}

}  // namespace spoolflow::apps
