#pragma once
/// A piece of batch work as text: which kind, with which arguments, over which files by their content; and what came of
/// it. What a kind means is known to the commands alone.
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace spoolflow::fleet {

/// Grows where the same piece would mean or give something else; then no result of before is taken.
inline constexpr int piece_format = 2;

/// A file that the fleet keeps.
struct PieceFile {
  std::string name;        ///< where the piece has it: a path below its folder, such as "@0@/run.csv"
  std::string sha256{};    ///< 64 hexadecimal digits
  std::int64_t bytes = 0;  ///< its size
};

struct Piece {
  std::string kind;         ///< "estimate"
  std::string arguments{};  ///< as the kind reads them
  std::vector<PieceFile> files{};
};

struct Outcome {
  int status = 0;  ///< as the command's exit status: 2 for an input that cannot be used, 1 where the work failed
  std::vector<std::string> messages{};  ///< where status is not 0
  std::string text{};                   ///< what the kind states beside its files, up to some thousand letters
  std::vector<PieceFile> files{};
};

/// Not what this program has written.
struct PieceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Whose workers give the same bytes: version of the program, piece_format and kind of machine.
[[nodiscard]] std::string piece_program(const std::string& version);
/// Of all that the result follows from, as 64 hexadecimal digits.
[[nodiscard]] std::string key_of(const Piece& piece, const std::string& program);

[[nodiscard]] std::string text_of(const Piece& piece);
/// Throws PieceError; also where a file's name leads out of the piece's folder.
[[nodiscard]] Piece read_piece(const std::string& text);
[[nodiscard]] std::string text_of(const Outcome& outcome);
/// Throws PieceError.
[[nodiscard]] Outcome read_outcome(const std::string& text);

}  // namespace spoolflow::fleet
