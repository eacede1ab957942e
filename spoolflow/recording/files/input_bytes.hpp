#pragma once
/// The bytes of a file or of standard input, from the first to the last.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace spoolflow::recording {

class InputBytes {
 public:
  /// "-" is standard input. Throws RecordingError: no such file, a folder, no permission.
  explicit InputBytes(const std::filesystem::path& file);
  /// Of a pipe or a connection that is open; closes it. A wait for bytes ends as if nothing more came within a tenth of
  /// a second after `given_up` says so.
  InputBytes(int descriptor, std::string name, std::function<bool()> given_up);
  ~InputBytes();
  InputBytes(const InputBytes&) = delete;
  InputBytes& operator=(const InputBytes&) = delete;

  /// Up to `room` bytes; fewer only at the end. Throws std::runtime_error where the device fails.
  std::size_t read(char* out, std::size_t room);
  /// What has come so far, up to `room` > 0 bytes; waits for the first. Zero only at the end. Throws as read() does.
  std::size_t read_some(char* out, std::size_t room);
  /// As the user named it; "standard input" for "-".
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Whether bytes come while others are still to be made: a pipe, a terminal, a socket.
  [[nodiscard]] bool comes_bit_by_bit() const { return !size_; }
  /// The length of a regular file; nothing for a pipe or a terminal.
  [[nodiscard]] std::optional<std::uint64_t> size() const { return size_; }
  /// Whether name() opens it, so that others can read it from there: not so of standard input, a file or not.
  [[nodiscard]] bool is_named_file() const { return owned_ && size_.has_value(); }
  [[nodiscard]] std::uint64_t position() const { return position_; }

 private:
  std::string name_;
  int descriptor_;
  bool owned_;
  [[nodiscard]] bool wait() const;

  std::function<bool()> given_up_;
  std::optional<std::uint64_t> size_;
  std::uint64_t position_ = 0;
};

/// A file, or what comes through standard input ("-"), opened as often as needed: of the latter a copy is kept in a
/// nameless file on disk. Throws std::runtime_error where there is no room for it.
class RepeatedInput {
 public:
  explicit RepeatedInput(std::filesystem::path file);
  ~RepeatedInput();
  RepeatedInput(const RepeatedInput&) = delete;
  RepeatedInput& operator=(const RepeatedInput&) = delete;

  /// From the first byte on.
  [[nodiscard]] std::unique_ptr<InputBytes> open() const;

 private:
  std::filesystem::path file_;
  int copy_ = -1;
};

}  // namespace spoolflow::recording
