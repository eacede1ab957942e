#pragma once
/// What a user may have meant who typed something else.
#include <string>
#include <string_view>
#include <vector>

namespace spoolflow::apps {

/// "; did you mean 'calibrate'?" for a misspelt word, or nothing where no candidate is near (a third of its letters).
[[nodiscard]] std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

/// What a file on the command line is, recognised by its first bytes and, of settings, by its ending.
enum class FileKind { model, settings, recording };

/// An input as typed, and what it should be.
struct Input {
  std::string file;
  FileKind wanted;
  std::string option = {};  ///< before it, with a space: "--recording "
};

/// Throws std::invalid_argument where the inputs of `command`, in the order in which it takes them, are in another
/// order
/// ("estimate takes the model first: …"), or one of them is plainly of another kind. What is missing, a pipe or of no
/// known kind is left to whoever reads it.
void refuse_other_kinds(std::string_view command, const std::vector<Input>& inputs);

}  // namespace spoolflow::apps
