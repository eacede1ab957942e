#pragma once
/// A process of its own for each piece: what ends it does not end the worker, and its memory goes with it.
#include <filesystem>
#include <functional>
#include <string>

namespace spoolflow::fleet {

/// A new folder below that for temporary files, of this process alone; removed with all that is in it. Those that
/// killed processes left are removed by `remove_abandoned_folders`.
class PieceFolder {
 public:
  PieceFolder();
  ~PieceFolder();
  PieceFolder(const PieceFolder&) = delete;
  PieceFolder& operator=(const PieceFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};
void remove_abandoned_folders();

/// `spoolflow piece` in that folder, by this program's own file. `go_on` is asked twice a second; where it says no, the
/// process is killed. Returns how it ended: its exit status, or minus the signal's number.
[[nodiscard]] int run_piece_process(const std::filesystem::path& folder, const std::function<bool()>& go_on);

/// Of the process of a piece, before it begins: it ends with the worker that started it, and leaves the processor to
/// whatever else wants it.
void become_piece_process();

}  // namespace spoolflow::fleet
