#pragma once
/// Files on the command line that are of another kind than the command takes there.
#include <string>
#include <string_view>
#include <vector>

namespace spoolflow::apps {

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
/// The same of a command that takes a model and then recordings.
void refuse_other_kinds(std::string_view command, const std::string& model, const std::vector<std::string>& recordings,
                        const std::vector<Input>& behind = {});

}  // namespace spoolflow::apps
