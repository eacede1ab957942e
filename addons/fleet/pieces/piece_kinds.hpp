#pragma once
/// The kinds of pieces that batch work falls into, and one of them at work in a process of its own.
#include <filesystem>
#include <functional>
#include <string>

#include "addons/fleet/jobs/piece.hpp"

namespace spoolflow::apps {

/// Does a piece whose files stand under their names below the present folder, writes its results there, and names them
/// in the outcome. Throws as commands do.
using PieceWork = std::function<fleet::Outcome(const fleet::Piece&)>;

/// Of the whole program, by the kind's name.
void add_piece_kind(const std::string& kind, PieceWork work);

/// A file of a piece, and the folder that it stands in. Throws std::runtime_error where the disk takes no more.
void write_piece_file(const std::filesystem::path& file, const std::string& content);

/// The piece of the present folder; its outcome, whatever it is, stands there behind it.
void do_piece_here();

}  // namespace spoolflow::apps
