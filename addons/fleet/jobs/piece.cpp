#include "addons/fleet/jobs/piece.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "spoolflow/model/provenance.hpp"

namespace spoolflow::fleet {
namespace {

using Json = nlohmann::json;

#if defined(__x86_64__)
constexpr const char* processor = "x86_64";
#elif defined(__aarch64__)
constexpr const char* processor = "aarch64";
#else
constexpr const char* processor = "other";
#endif

Json json_of(const std::vector<PieceFile>& files) {
  Json out = Json::array();
  for (const PieceFile& file : files)
    out.push_back({{"name", file.name}, {"sha256", file.sha256}, {"bytes", file.bytes}});
  return out;
}

bool stays_inside(const std::string& name) {
  const std::filesystem::path path(name);
  return !name.empty() && path.is_relative() &&
         std::ranges::none_of(path, [](const auto& part) { return part == ".."; });
}

std::vector<PieceFile> files_of(const Json& json) {
  std::vector<PieceFile> out;
  for (const Json& file : json) {
    out.push_back({file.at("name").get<std::string>(), file.at("sha256").get<std::string>(),
                   file.at("bytes").get<std::int64_t>()});
    if (!stays_inside(out.back().name)) throw PieceError("a piece's file has a name that leads out of its folder");
  }
  return out;
}

/// Text as it came, whatever its letters are.
std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string piece_program(const std::string& version) {
  return fmt::format("spoolflow {} pieces {} {}", version, piece_format, processor);
}

std::string key_of(const Piece& piece, const std::string& program) {
  return model::sha256_of_text(program + "\n" + text_of(piece));
}

std::string text_of(const Piece& piece) {
  return text_of(Json{{"kind", piece.kind}, {"arguments", piece.arguments}, {"files", json_of(piece.files)}});
}

Piece read_piece(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    return {json.at("kind").get<std::string>(), json.at("arguments").get<std::string>(), files_of(json.at("files"))};
  } catch (const Json::exception&) {
    throw PieceError("a piece's text is none that this program has written");
  }
}

std::string text_of(const Outcome& outcome) {
  return text_of(Json{{"status", outcome.status},
                      {"messages", outcome.messages},
                      {"text", outcome.text},
                      {"files", json_of(outcome.files)}});
}

Outcome read_outcome(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    return {json.at("status").get<int>(), json.at("messages").get<std::vector<std::string>>(),
            json.at("text").get<std::string>(), files_of(json.at("files"))};
  } catch (const Json::exception&) {
    throw PieceError("a piece's outcome is none that this program has written");
  }
}

}  // namespace spoolflow::fleet
