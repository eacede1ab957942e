#pragma once
/// The only place that opens outputs. A file appears under its name only when it is complete.
#include <filesystem>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "spoolflow/recording/written_tables/table_output.hpp"

namespace spoolflow::apps {

/// An output that cannot be written: exit status 2.
struct OutputError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Nobody reads standard output any more (`spoolflow … | head`): the program ends quietly, as cat and grep do.
struct ReaderGone : std::runtime_error {
  ReaderGone() : std::runtime_error("the reader of standard output went away") {}
};

/// Writes to a temporary file beside the target and gives it the target's name on commit(); what stood there before
/// stays untouched until then, and for good if commit() is never reached (error, interruption). What a killed run left
/// beside the target is removed.
/// "-" is standard output, of one output at a time; devices and pipes (/dev/null, /dev/stdout, a FIFO) are written
/// directly.
class OutputFile : public recording::TableOutput {
 public:
  /// `also_used`: files that the same command reads or writes; the target must be none of them. Throws OutputError
  /// where it is, where standard output is another's, where its folder does not exist, where it is itself a folder, or
  /// where writing is not permitted.
  explicit OutputFile(const std::filesystem::path& target, const std::vector<std::filesystem::path>& also_used = {});
  /// Without commit(): removes the temporary file.
  ~OutputFile() override;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Buffered by 256 KiB. A failed write (full disk, size limit) throws OutputError or ReaderGone from the call that
  /// hits it: no need to look at the stream's state.
  [[nodiscard]] std::ostream& stream();
  /// The same, for the tables' writers.
  std::ostream& in_sequence() override { return stream(); }
  /// Unbuffered; throws OutputError where the output is standard output, a pipe or a device.
  recording::PlacedBytes& in_places() override;
  /// A second temporary file beside the target, removed with this one, never given a name. Throws as in_places().
  recording::PlacedBytes& scratch() override;
  /// Writes what is buffered, closes, and puts the file under its name. No fsync: the name changes hands at once for
  /// every reader, and a power cut is answered by running the command again.
  void commit();
  /// The part of commit() that a full disk can stop: writes what is buffered and closes.
  void finish();

 private:
  struct Target;
  std::unique_ptr<Target> target_;
  std::unique_ptr<OutputFile> scratch_;
};

/// The outputs of one command, none of which is one of its inputs or another output.
class Outputs {
 public:
  /// `inputs`: files that the command reads; a name that is empty is none.
  explicit Outputs(std::vector<std::filesystem::path> inputs = {}) : used_(std::move(inputs)) {
    std::erase(used_, std::filesystem::path());
  }
  /// Throws as OutputFile().
  OutputFile& open(const std::filesystem::path& target);
  /// Null where the target has no name.
  OutputFile* open_if_named(const std::filesystem::path& target) { return target.empty() ? nullptr : &open(target); }
  /// None appears before all are finished.
  void commit();

 private:
  std::vector<std::filesystem::path> used_;
  std::vector<std::unique_ptr<OutputFile>> files_;
};

/// A file of that content. Throws as OutputFile().
inline void write_file(const std::filesystem::path& target, const std::vector<std::filesystem::path>& also_used,
                       std::string_view content) {
  OutputFile output(target, also_used);
  output.stream() << content;
  output.commit();
}

/// Makes a folder for outputs, parents included, unless it is there. Throws OutputError.
void make_output_folder(const std::filesystem::path& folder);

/// For a folder in which this command has written nothing yet: throws OutputError where one of these files stands
/// there.
void keep_what_is_there(const std::filesystem::path& folder, const std::vector<std::string>& names,
                        const std::string& command);

}  // namespace spoolflow::apps
