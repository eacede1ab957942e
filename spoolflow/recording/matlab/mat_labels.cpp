#include "spoolflow/recording/matlab/mat_labels.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <initializer_list>

#include "spoolflow/recording/channels/utf8.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t longest_label = 4096;

std::string lower(std::string_view text) {
  std::string out(text);
  std::ranges::transform(out, out.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

template <std::size_t count>
bool is_one_of(const std::array<std::string_view, count>& names, std::string_view field) {
  return std::ranges::find(names, lower(field)) != names.end();
}

std::string trimmed(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20; }, ' ');  // block names have line ends
  text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
  text.resize(text.find_last_not_of(' ') + 1);
  return text;
}

/// The rows of a char matrix; of one row all of its bytes, as UTF-8 may have more of them than characters.
std::vector<std::string> rows_of_text(const matvar_t& text) {
  if (text.class_type != MAT_C_CHAR || text.data == nullptr || text.rank != 2 || text.dims == nullptr) return {};
  const bool wide = text.data_type == MAT_T_UINT16 || text.data_type == MAT_T_UTF16;
  if (!wide && text.data_type != MAT_T_UINT8 && text.data_type != MAT_T_UTF8 && text.data_type != MAT_T_INT8) return {};
  const std::size_t units = text.nbytes / (wide ? 2 : 1), rows = text.dims[0];
  if (rows == 0 || units == 0 || units > longest_label || (rows > 1 && units != rows * text.dims[1])) return {};
  std::vector<std::string> out(rows);
  for (std::size_t k = 0; k < units; ++k) {
    std::string& row = out[k % rows];
    if (wide) {
      append_utf8(row, static_cast<const std::uint16_t*>(text.data)[k]);
    } else {
      row += static_cast<const char*>(text.data)[k];
    }
  }
  for (std::string& row : out) row = trimmed(std::move(row));
  return out;
}

/// Texts of a char matrix or a cell of texts.
std::vector<std::string> texts_of(matvar_t* text) {
  if (text == nullptr) return {};
  if (text->class_type != MAT_C_CELL) return rows_of_text(*text);
  std::vector<std::string> out;
  if (text->data == nullptr || text->rank != 2 || text->dims == nullptr) return out;
  const std::size_t cells = std::min(text->dims[0] * text->dims[1], longest_label);
  for (std::size_t k = 0; k < cells; ++k) {
    const matvar_t* const cell = Mat_VarGetCell(text, static_cast<int>(k));
    std::vector<std::string> rows = cell == nullptr ? std::vector<std::string>() : rows_of_text(*cell);
    out.push_back(rows.size() == 1 ? std::move(rows.front()) : "");
  }
  return out;
}

/// A struct on the way to the numbers, and which of its elements.
struct Owner {
  matvar_t* variable;
  std::size_t element;
  std::string called;  ///< the variable or field that holds it

  /// The field of that name, in whatever case; null where there is none.
  [[nodiscard]] matvar_t* field(std::string_view wanted, std::size_t of) const {
    char* const* const names = Mat_VarGetStructFieldnames(variable);
    const unsigned count = names == nullptr ? 0 : Mat_VarGetNumberOfFields(variable);
    for (unsigned k = 0; k < count; ++k) {
      if (names[k] != nullptr && lower(names[k]) == wanted) return Mat_VarGetStructFieldByIndex(variable, k, of);
    }
    return nullptr;
  }
  [[nodiscard]] matvar_t* field(std::string_view wanted) const { return field(wanted, element); }

  /// The first text of the first of those fields that holds one.
  [[nodiscard]] std::string text(std::initializer_list<std::string_view> fields) const {
    for (const std::string_view name : fields) {
      const std::vector<std::string> texts = texts_of(field(name));
      if (texts.size() == 1 && !texts.front().empty()) return texts.front();
    }
    return {};
  }
};

/// The structs along the path, the innermost first.
std::vector<Owner> owners_of(matvar_t& root, const std::vector<MatStep>& path) {
  std::vector<Owner> out;
  matvar_t* at = &root;
  for (std::size_t k = 1; k < path.size() && at != nullptr && at->class_type == MAT_C_STRUCT; ++k) {
    out.insert(out.begin(), {at, path[k].element, path[k - 1].field});
    at = Mat_VarGetStructFieldByName(at, path[k].field.c_str(), path[k].element);
  }
  return out;
}

std::vector<std::string> split_list(const std::string& text) {
  std::vector<std::string> out(1);
  for (const char c : text) {
    if (c == ',') {
      out.emplace_back();
    } else if (c != '<' && c != '>') {  // of signals that a label is inherited from
      out.back() += c;
    }
  }
  for (std::string& each : out) each = trimmed(std::move(each));
  return out;
}

/// The block that a signal comes from: all signals of a scope are said to come from the scope.
std::string block_of(const Owner& owner) {
  const std::string block = owner.text({"blockname", "blockpath"});
  if (block.empty() || owner.variable->dims == nullptr) return {};
  const std::size_t elements = owner.variable->dims[0] * owner.variable->dims[1];
  for (std::size_t other = 0; other < elements; ++other) {
    if (other != owner.element && Owner{owner.variable, other, ""}.text({"blockname", "blockpath"}) == block) return {};
  }
  return trimmed(block.substr(block.rfind('/') + 1));
}

/// Fields of which every log has one: they name no signal.
bool is_of_any_log(std::string_view field) {
  constexpr std::array<std::string_view, 6> names{"signals", "signal", "values", "data", "elements", "element"};
  return is_one_of(names, field);
}

std::string unit_of(const Owner& owner) {
  if (std::string unit = owner.text({"unit", "units"}); !unit.empty()) return unit;
  matvar_t* const info = owner.field("datainfo");
  if (info == nullptr || info->class_type != MAT_C_STRUCT) return {};
  const Owner inside{info, 0, ""};
  if (std::string unit = inside.text({"unit", "units"}); !unit.empty()) return unit;
  matvar_t* const units = inside.field("units");  // an object of class Unit saved as a struct
  return units == nullptr || units->class_type != MAT_C_STRUCT ? "" : Owner{units, 0, ""}.text({"name"});
}

}  // namespace

bool is_labelled_field(std::string_view field) {
  constexpr std::array<std::string_view, 4> names{"values", "value", "data", "signal"};
  return is_one_of(names, field);
}

bool is_annotation(std::string_view field) {
  constexpr std::array<std::string_view, 21> names{"label",
                                                   "dimensions",
                                                   "valuedimensions",
                                                   "plotstyle",
                                                   "title",
                                                   "blockname",
                                                   "blockpath",
                                                   "statename",
                                                   "inreferencedmodel",
                                                   "name",
                                                   "unit",
                                                   "units",
                                                   "datainfo",
                                                   "timeinfo",
                                                   "qualityinfo",
                                                   "quality",
                                                   "treatnanasmissing",
                                                   "istimefirst",
                                                   "isuniform",
                                                   "userdata",
                                                   "events"};
  return is_one_of(names, field);
}

MatLabel label_of(matvar_t& root, const std::vector<MatStep>& path, std::size_t part, std::size_t parts) {
  MatLabel out;
  const std::vector<Owner> owners = owners_of(root, path);
  for (const Owner& owner : owners) {
    if (out.unit.empty()) out.unit = unit_of(owner);
    if (parts > 1) {
      std::vector<std::string> texts = texts_of(owner.field("label"));
      if (texts.size() == 1) texts = split_list(texts.front());
      if (texts.size() == parts) return {texts[part], out.unit, false};
    }
    if (out.name.empty()) out.name = owner.text({"label", "name", "signalname"});
    if (out.name.empty()) out.name = block_of(owner);
    if (out.name.empty() && !is_of_any_log(owner.called) && owner.field("time") != nullptr &&
        owner.field("signals") == nullptr) {
      out.name = owner.called;
    }
    if (!out.name.empty() || !is_of_any_log(owner.called)) break;
  }
  return out;
}

std::string unit_of_time_in(matvar_t& root, const std::vector<MatStep>& path) {
  const std::vector<Owner> owners = owners_of(root, path);
  if (owners.empty()) return {};
  if (owners.front().field("signals") != nullptr) return "s";
  matvar_t* const info = owners.front().field("timeinfo");
  if (info == nullptr || info->class_type != MAT_C_STRUCT) return {};
  const std::string written = lower(Owner{info, 0, ""}.text({"units", "unit"}));
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> words{
      {{"seconds", "s"}, {"milliseconds", "ms"}, {"microseconds", "us"}}};
  const auto* const known = std::ranges::find(words, written, &std::pair<std::string_view, std::string_view>::first);
  return known == words.end() ? written : std::string(known->second);
}

}  // namespace spoolflow::recording
