#pragma once
/// Visitors that carry the sensor's tables into JSON and back.
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "spoolflow/model/json_node.hpp"
#include "spoolflow/sensor/table.hpp"

namespace spoolflow::model {

class TableWriter {
 public:
  explicit TableWriter(nlohmann::ordered_json& out) : out_(out) {}

  template <class T, int Rows, int Columns>
  void map(const char* key, const sensor::Map<T, Rows, Columns>& map, const char* row_key, const char* column_key) {
    auto values = nlohmann::ordered_json::array();
    for (int row = 0; row < Rows; ++row) {
      auto line = nlohmann::ordered_json::array();
      for (int column = 0; column < Columns; ++column) line.push_back(map.node(row, column));
      values.push_back(std::move(line));
    }
    out_[key] = {{row_key, points<Rows>(map.row_axis)},
                 {column_key, points<Columns>(map.column_axis)},
                 {"values", std::move(values)}};
  }
  template <class T, int Points>
  void curve(const char* key, const sensor::Curve<T, Points>& curve, const char* axis_key) {
    out_[key] = {{axis_key, points<Points>(curve.axis)}, {"values", curve.values}};
  }
  template <class T, int Layers, int Rows, int Columns>
  void volume(const char* key, const sensor::Volume<T, Layers, Rows, Columns>& volume) {
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
    out_[key] = std::move(layers);
  }
  template <class T>
  void axis(const char* key, const sensor::Axis<T>& axis, int points) {
    auto out = nlohmann::ordered_json::array();
    for (int k = 0; k < points; ++k) out.push_back(axis.at(k));
    out_[key] = std::move(out);
  }
  template <class T, std::size_t Count>
  void list(const char* key, const std::array<T, Count>& values, double /*lowest*/, double /*highest*/) {
    out_[key] = values;
  }
  template <class T>
  void number(const char* key, const T& value, double /*lowest*/, double /*highest*/) {
    out_[key] = value;
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
  void map(const char* key, sensor::Map<T, Rows, Columns>& map, const char* row_key, const char* column_key) {
    const JsonNode node = in_.at(key);
    map.row_axis = axis<T>(node.at(row_key), Rows);
    map.column_axis = axis<T>(node.at(column_key), Columns);
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
  void curve(const char* key, sensor::Curve<T, Points>& curve, const char* axis_key) {
    const JsonNode node = in_.at(key);
    curve.axis = axis<T>(node.at(axis_key), Points);
    const std::vector<double> values = node.at("values").numbers();
    require_count(node.at("values"), values.size(), Points);
    for (std::size_t k = 0; k < values.size(); ++k) curve.values[k] = static_cast<T>(values[k]);
  }
  template <class T, int Layers, int Rows, int Columns>
  void volume(const char* key, sensor::Volume<T, Layers, Rows, Columns>& volume) {
    const JsonNode node = in_.at(key);
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
  void axis(const char* key, sensor::Axis<T>& out, int points) {
    out = axis<T>(in_.at(key), points);
  }
  template <class T, std::size_t Count>
  void list(const char* key, std::array<T, Count>& out, double lowest, double highest) {
    const JsonNode node = in_.at(key);
    const std::vector<JsonNode> entries = node.elements();
    require_count(node, entries.size(), static_cast<int>(Count));
    for (std::size_t k = 0; k < Count; ++k) out[k] = static_cast<T>(entries[k].number(lowest, highest));
  }
  template <class T>
  void number(const char* key, T& value, double lowest, double highest) {
    value = static_cast<T>(in_.at(key).number(lowest, highest));
  }

 private:
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
