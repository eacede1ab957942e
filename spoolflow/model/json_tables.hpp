#pragma once
/// Visitors that carry what is described into JSON and back. Reading looks at types, sizes and axes; whether the
/// numbers are such as the sensor needs is looked at by LimitCheck.
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "spoolflow/model/json_node.hpp"
#include "spoolflow/model/parameter.hpp"
#include "spoolflow/sensor/basis/table.hpp"

namespace spoolflow::model {

/// Keys of older model files, which are read and never written.
struct FormerKey {
  std::string_view key;  ///< in the older file
  std::string_view now;  ///< what it is called
  bool squared;          ///< the older file holds the square root
};
inline constexpr std::array former_keys{FormerKey{"least_liveliness", "least_process_noise", true},
                                        FormerKey{"first_liveliness", "first_process_noise", false},
                                        FormerKey{"yielding_s", "constrained_correction_s", false},
                                        FormerKey{"band_unseen_factor", "band_unobserved_factor", false}};

class TableWriter {
 public:
  explicit TableWriter(nlohmann::ordered_json& out) : out_(out) {}

  template <class T, int Rows, int Columns>
  void map(const TableParameter& about, const sensor::Map<T, Rows, Columns>& map) {
    auto values = nlohmann::ordered_json::array();
    for (int row = 0; row < Rows; ++row) {
      auto line = nlohmann::ordered_json::array();
      for (int column = 0; column < Columns; ++column) line.push_back(map.node(row, column));
      values.push_back(std::move(line));
    }
    out_[about.key] = {{about.rows.key, points<Rows>(map.row_axis)},
                       {about.columns.key, points<Columns>(map.column_axis)},
                       {"values", std::move(values)}};
  }
  template <class T, int Points>
  void curve(const TableParameter& about, const sensor::Curve<T, Points>& curve) {
    out_[about.key] = {{about.columns.key, points<Points>(curve.axis)}, {"values", curve.values}};
  }
  template <class T, int Layers, int Rows, int Columns>
  void volume(const TableParameter& about, const sensor::Volume<T, Layers, Rows, Columns>& volume) {
    auto layers = nlohmann::ordered_json::array();
    for (int layer = 0; layer < Layers; ++layer) {
      auto rows = nlohmann::ordered_json::array();
      for (int row = 0; row < Rows; ++row) {
        auto line = nlohmann::ordered_json::array();
        for (int column = 0; column < Columns; ++column) line.push_back(volume.node(layer, row, column));
        rows.push_back(std::move(line));
      }
      layers.push_back(std::move(rows));
    }
    out_[about.key] = std::move(layers);
  }
  template <class T>
  void axis(const AxisParameter& about, const sensor::Axis<T>& axis, int points) {
    auto out = nlohmann::ordered_json::array();
    for (int k = 0; k < points; ++k) out.push_back(axis.at(k));
    out_[about.key] = std::move(out);
  }
  template <class T, std::size_t Count>
  void list(const Parameter& about, const std::array<T, Count>& values) {
    out_[about.key] = values;
  }
  template <class T>
  void number(const Parameter& about, const T& value) {
    out_[about.key] = value;
  }
  template <class T>
  void number(const Parameter& about, const std::optional<T>& value) {
    if (value) out_[about.key] = *value;
  }

 private:
  template <int Points, class T>
  static nlohmann::ordered_json points(const sensor::Axis<T>& axis) {
    auto out = nlohmann::ordered_json::array();
    for (int k = 0; k < Points; ++k) out.push_back(axis.at(k));
    return out;
  }
  nlohmann::ordered_json& out_;
};

class TableReader {
 public:
  explicit TableReader(const JsonNode& in) : in_(in) {}

  template <class T, int Rows, int Columns>
  void map(const TableParameter& about, sensor::Map<T, Rows, Columns>& map) {
    const JsonNode node = in_.at(about.key);
    map.row_axis = axis<T>(node.at(about.rows.key), Rows);
    map.column_axis = axis<T>(node.at(about.columns.key), Columns);
    const std::vector<JsonNode> lines = node.at("values").elements();
    require_count(node.at("values"), lines.size(), Rows);
    for (int row = 0; row < Rows; ++row) {
      const JsonNode& line = lines[static_cast<std::size_t>(row)];
      const std::vector<double> values = line.numbers();
      require_count(line, values.size(), Columns);
      for (int column = 0; column < Columns; ++column) {
        map.node(row, column) = static_cast<T>(values[static_cast<std::size_t>(column)]);
      }
    }
  }
  template <class T, int Points>
  void curve(const TableParameter& about, sensor::Curve<T, Points>& curve) {
    const JsonNode node = in_.at(about.key);
    curve.axis = axis<T>(node.at(about.columns.key), Points);
    const std::vector<double> values = node.at("values").numbers();
    require_count(node.at("values"), values.size(), Points);
    for (std::size_t k = 0; k < values.size(); ++k) curve.values[k] = static_cast<T>(values[k]);
  }
  template <class T, int Layers, int Rows, int Columns>
  void volume(const TableParameter& about, sensor::Volume<T, Layers, Rows, Columns>& volume) {
    const JsonNode node = in_.at(about.key);
    const std::vector<JsonNode> layers = node.elements();
    require_count(node, layers.size(), Layers);
    for (int layer = 0; layer < Layers; ++layer) {
      const JsonNode& sheet = layers[static_cast<std::size_t>(layer)];
      const std::vector<JsonNode> lines = sheet.elements();
      require_count(sheet, lines.size(), Rows);
      for (int row = 0; row < Rows; ++row) {
        const JsonNode& line = lines[static_cast<std::size_t>(row)];
        const std::vector<double> values = line.numbers();
        require_count(line, values.size(), Columns);
        for (int column = 0; column < Columns; ++column) {
          volume.node(layer, row, column) = static_cast<T>(values[static_cast<std::size_t>(column)]);
        }
      }
    }
  }
  template <class T>
  void axis(const AxisParameter& about, sensor::Axis<T>& out, int points) {
    out = axis<T>(in_.at(about.key), points);
  }
  template <class T, std::size_t Count>
  void list(const Parameter& about, std::array<T, Count>& out) {
    const JsonNode node = in_.at(about.key);
    const std::vector<JsonNode> entries = node.elements();
    require_count(node, entries.size(), static_cast<int>(Count));
    for (std::size_t k = 0; k < Count; ++k) out[k] = static_cast<T>(entries[k].number());
  }
  template <class T>
  void number(const Parameter& about, T& value) {
    value = static_cast<T>(in_.has(about.key) ? in_.at(about.key).number() : missing(about));
  }
  template <class T>
  void number(const Parameter& about, std::optional<T>& value) {
    if (in_.has(about.key)) value = static_cast<T>(in_.at(about.key).number());
  }

 private:
  /// What a file without that key holds: the same under a former key, or what the description says.
  [[nodiscard]] double missing(const Parameter& about) const {
    for (const FormerKey& former : former_keys) {
      if (former.now != about.key || !in_.has(std::string(former.key).c_str())) continue;
      const double value = in_.at(std::string(former.key).c_str()).number();
      return former.squared ? value * value : value;
    }
    return about.otherwise ? *about.otherwise : in_.at(about.key).number();
  }
  static void require_count(const JsonNode& node, std::size_t found, int wanted) {
    if (found != static_cast<std::size_t>(wanted)) {
      node.refuse(fmt::format("has {} entries, the sensor's table has {}", found, wanted));
    }
  }
  template <class T>
  static sensor::Axis<T> axis(const JsonNode& node, int points) {
    const std::vector<double> values = node.rising_numbers();
    require_count(node, values.size(), points);
    const double spacing = (values.back() - values.front()) / (points - 1);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double expected = values.front() + static_cast<double>(k) * spacing;
      if (std::abs(values[k] - expected) > 1e-6 * spacing) {
        node.refuse(fmt::format("entry {} is {}, equal steps would give {}; the sensor's axes rise in equal steps", k,
                                values[k], expected));
      }
    }
    return {static_cast<T>(values.front()), static_cast<T>(spacing), static_cast<T>(1 / spacing)};
  }
  const JsonNode& in_;
};

}  // namespace spoolflow::model
