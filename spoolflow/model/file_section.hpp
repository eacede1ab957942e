#pragma once
/// A section of a model file, which a description either reads or writes: what is described once goes both ways.
/// Reading looks at types, sizes and axes; whether the numbers are such as the sensor needs is looked at by LimitCheck.
#include <array>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "spoolflow/model/json_node.hpp"
#include "spoolflow/model/parameter.hpp"
#include "spoolflow/sensor/basis/table.hpp"

namespace spoolflow::model {

/// Which files hold an entry.
enum class Held {
  always,
  lately,    ///< all but older ones
  where_any  ///< those in which it is not empty
};

/// Every entry has a key, and a place for its value: it is read into that, or written from it. Reading throws
/// ModelError, with the JSON path, for an entry that is missing, of another type or outside its limits.
class FileSection {
 public:
  explicit FileSection(const JsonNode& in) : in_(&in) {}
  explicit FileSection(nlohmann::ordered_json& out) : out_(&out) {}

  void text(const char* key, std::string& value);
  void one_of(const char* key, std::string& value, std::initializer_list<const char*> allowed);
  /// A flag that is written as one of two words.
  void either(const char* key, bool& value, const char* yes, const char* no);
  /// A flag that is written as a word, or not at all.
  void mark(const char* key, bool& value, const char* word);
  /// Version of the program: "spoolflow 1.0.0".
  void tool(const char* key, std::string& version);
  void sha256(const char* key, std::string& digits);
  template <class Number>
  void number(const char* key, Number& value, const Limits& limits = {-1e15, 1e15}, Held held = Held::always) {
    if (!holds(key, false, held)) return;
    if (writes()) {
      (*out_)[key] = value;
    } else {
      value = static_cast<Number>(in_->at(key).number(limits.lowest, limits.highest));
    }
  }
  void number(const char* key, std::optional<double>& value, const Limits& limits) {
    if (holds(key, !value, Held::where_any)) number(key, value ? *value : value.emplace(), limits);
  }
  /// So many, where `count` is given.
  void numbers(const char* key, std::vector<double>& values, std::optional<std::size_t> count = {});
  void rising_numbers(const char* key, std::vector<double>& values);
  void range(const char* key, double& lower, double& upper);
  void texts(const char* key, std::vector<std::string>& values, Held held = Held::always);

  template <class Section>
  using Describe = void (*)(Section&, FileSection&);

  template <class Section>
  void section(const char* key, Section& section, Describe<Section> describe) {
    within(key, [&](FileSection& file) { describe(section, file); });
  }
  /// In those files that have it.
  template <class Section>
  void section(const char* key, std::optional<Section>& value, Describe<Section> describe) {
    if (holds(key, !value, Held::where_any)) section(key, value ? *value : value.emplace(), describe);
  }
  template <class Section>
  void list(const char* key, std::vector<Section>& sections, Describe<Section> describe, Held held = Held::always) {
    if (!holds(key, sections.empty(), held)) return;
    if (writes()) {
      nlohmann::ordered_json& all = (*out_)[key] = nlohmann::ordered_json::array();
      for (Section& each : sections) {
        FileSection file(all.emplace_back(nlohmann::ordered_json::object()));
        describe(each, file);
      }
    } else {
      for (const JsonNode& each : in_->at(key).elements()) {
        FileSection file(each);
        describe(sections.emplace_back(), file);
      }
    }
  }

  // As a visitor of what the sensor has (describe_observer.hpp):

  template <class T>
  void number(const Parameter& about, T& value) {
    if (writes()) {
      (*out_)[about.key] = value;
    } else {
      value = static_cast<T>(in_->has(about.key) ? in_->at(about.key).number() : missing(about));
    }
  }
  template <class T>
  void number(const Parameter& about, std::optional<T>& value) {
    if (holds(about.key, !value, Held::where_any)) number(about, value ? *value : value.emplace());
  }
  template <class T, std::size_t Count>
  void list(const Parameter& about, std::array<T, Count>& values) {
    row(about.key, values);
  }
  template <class T>
  void axis(const AxisParameter& about, sensor::Axis<T>& axis, int points) {
    std::vector<double> values;
    for (int k = 0; writes() && k < points; ++k) values.push_back(static_cast<double>(axis.at(k)));
    rising_numbers(about.key, values);
    if (writes()) return;
    const double spacing = even_spacing(in_->at(about.key), values, points);
    axis = {static_cast<T>(values.front()), static_cast<T>(spacing), static_cast<T>(1 / spacing)};
  }
  template <class T, int Points>
  void curve(const TableParameter& about, sensor::Curve<T, Points>& curve) {
    within(about.key, [&](FileSection& table) {
      table.axis(about.columns, curve.axis, Points);
      table.row("values", curve.values);
    });
  }
  template <class T, int Rows, int Columns>
  void map(const TableParameter& about, sensor::Map<T, Rows, Columns>& map) {
    within(about.key, [&](FileSection& table) {
      table.axis(about.rows, map.row_axis, Rows);
      table.axis(about.columns, map.column_axis, Columns);
      table.arrays("values", {Rows, Columns}, [&](int k) -> T& { return map.node(k / Columns, k % Columns); });
    });
  }
  template <class T, int Layers, int Rows, int Columns>
  void volume(const TableParameter& about, sensor::Volume<T, Layers, Rows, Columns>& volume) {
    arrays(about.key, {Layers, Rows, Columns},
           [&](int k) -> T& { return volume.node(k / (Rows * Columns), k / Columns % Rows, k % Columns); });
  }

  /// Whether the entry is to be read, or to be written.
  [[nodiscard]] bool holds(const char* key, bool empty, Held held) const {
    if (writes()) return held != Held::where_any || !empty;
    return held == Held::always || in_->has(key);
  }

 private:
  [[nodiscard]] bool writes() const { return out_ != nullptr; }
  template <class DescribeSection>
  void within(const char* key, const DescribeSection& describe) {
    if (writes()) {
      FileSection file((*out_)[key] = nlohmann::ordered_json::object());
      describe(file);
    } else {
      const JsonNode in = in_->at(key);
      FileSection file(in);
      describe(file);
    }
  }
  template <class T, std::size_t Count>
  void row(const char* key, std::array<T, Count>& values) {
    arrays(key, {static_cast<int>(Count)}, [&](int k) -> T& { return values[static_cast<std::size_t>(k)]; });
  }
  /// The numbers at(0), at(1), … as arrays within each other, of these lengths.
  template <class At>
  void arrays(const char* key, std::initializer_list<int> lengths, const At& at) {
    int k = 0;
    if (writes()) {
      write_arrays((*out_)[key], lengths, at, k);
    } else {
      read_arrays(in_->at(key), lengths, at, k);
    }
  }
  template <class At>
  static void write_arrays(nlohmann::ordered_json& out, std::span<const int> lengths, const At& at, int& k) {
    if (lengths.empty()) {
      out = at(k++);
      return;
    }
    out = nlohmann::ordered_json::array();
    for (int n = 0; n < lengths.front(); ++n) write_arrays(out.emplace_back(nullptr), lengths.subspan(1), at, k);
  }
  template <class At>
  static void read_arrays(const JsonNode& in, std::span<const int> lengths, const At& at, int& k) {
    if (lengths.empty()) {
      auto& number = at(k++);
      number = static_cast<std::remove_reference_t<decltype(number)>>(in.number());
      return;
    }
    const std::vector<JsonNode> elements = in.elements();
    require_count(in, elements.size(), lengths.front());
    for (const JsonNode& each : elements) read_arrays(each, lengths.subspan(1), at, k);
  }
  static void require_count(const JsonNode& node, std::size_t found, int wanted);
  static double even_spacing(const JsonNode& node, const std::vector<double>& values, int points);
  /// What a file without that key holds: the same under a former key, or what the description says.
  [[nodiscard]] double missing(const Parameter& about) const;

  const JsonNode* in_ = nullptr;
  nlohmann::ordered_json* out_ = nullptr;
};

}  // namespace spoolflow::model
