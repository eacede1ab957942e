#include "spoolflow/apps/terminal/input_kind.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "spoolflow/recording/channels/byte_order_mark.hpp"

namespace spoolflow::apps {
namespace {

std::optional<FileKind> kind_of(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
  if (file.ends_with(".toml")) return FileKind::settings;
  std::array<char, 512> beginning{};
  std::ifstream in(file, std::ios::binary);
  in.read(beginning.data(), beginning.size());
  const std::string_view text =
      recording::without_byte_order_mark({beginning.data(), static_cast<std::size_t>(in.gcount())});
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return std::nullopt;
  if (text[first] == '{' && !text.substr(first).starts_with("{\\rtf")) return FileKind::model;
  const std::string_view line = text.substr(first, text.find('\n', first) - first);
  const bool maybe_settings =
      line.starts_with('[') || line.starts_with('#') || line.find('=') != std::string_view::npos;
  return maybe_settings ? std::nullopt : std::optional(FileKind::recording);
}

std::string_view name_of(FileKind kind) {
  constexpr std::array<std::string_view, 3> names{"a model", "TOML", "a recording"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace

void refuse_other_kinds(std::string_view command, const std::vector<Input>& inputs) {
  std::vector<Input> ordered;  // by what each should be, as it is
  const Input* wrong = nullptr;
  FileKind found{};
  for (const Input& input : inputs) {
    const std::optional<FileKind> kind = kind_of(input.file);
    ordered.push_back({input.file, kind.value_or(input.wanted), {}});
    // A model that is no JSON has its own message, which reports where it is damaged.
    const bool plain = kind && *kind != input.wanted && input.wanted != FileKind::model;
    if (plain && wrong == nullptr) wrong = &input, found = *kind;
  }
  if (wrong == nullptr) return;
  std::ranges::stable_sort(ordered, {}, &Input::wanted);
  const bool only_swapped =
      std::ranges::equal(ordered, inputs, {}, &Input::wanted, &Input::wanted) && inputs.size() > 1;
  if (only_swapped) {
    std::string line;
    for (std::size_t k = 0; k < ordered.size(); ++k) line += fmt::format(" {}{}", inputs[k].option, ordered[k].file);
    throw std::invalid_argument(fmt::format("{} is {}, and {} comes first: write spoolflow {}{}", wrong->file,
                                            name_of(found), name_of(ordered.front().wanted), command, line));
  }
  throw std::invalid_argument(fmt::format(
      "{}: is {}, where {} should be named{}; see spoolflow {} --help", wrong->file,
      found == FileKind::model ? "JSON, as models are" : name_of(found), name_of(wrong->wanted),
      wrong->wanted == FileKind::recording ? " (CSV with a line of names above the numbers, HDF5, MAT, TDMS, MDF 4)"
                                           : "",
      command));
}

void refuse_other_kinds(std::string_view command, const std::string& model, const std::vector<std::string>& recordings,
                        const std::vector<Input>& behind) {
  std::vector<Input> inputs{{model, FileKind::model}};
  for (const std::string& recording : recordings) inputs.push_back({recording, FileKind::recording});
  inputs.insert(inputs.end(), behind.begin(), behind.end());
  refuse_other_kinds(command, inputs);
}

}  // namespace spoolflow::apps
