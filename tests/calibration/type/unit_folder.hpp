#pragma once
/// A unit of the example's type in a folder of its own.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/calibration/type/calibrate_unit.hpp"
#include "spoolflow/calibration/type/type_model.hpp"
#include "spoolflow/calibration/type/unit_evidence.hpp"
#include "spoolflow/calibration/type/unit_parameters.hpp"
#include "spoolflow/recording/reader.hpp"
#include "tests/calibration/type/virtual_unit.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::calibration {

inline const model::Model& type() {
  static const model::Model model = [] {
    model::Model valve = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
    // Positions of the virtual unit are free of drift.
    valve.observer->parameters.position_sensor.drift_m_per_K = 0;
    return type_model(std::move(valve), tolerances_from({}));
  }();
  return model;
}

/// Of a valve of one direction.
template <class... Arguments>
UnitCalibration calibrated_unit(const Arguments&... arguments) {
  return calibrate_unit(arguments...).directions.at(0);
}

/// The type's file, a unit's campaign and its recordings in one folder.
class UnitFolder {
 public:
  explicit UnitFolder(const Deviations& deviations, double slip_m = 0)
      : file_("unit.toml",
              "name = \"U 17\"\n[[recording]]\nprotocol = \"unpressurised_strokes\"\nfile = \"dry.csv\"\n"
              "[[recording]]\nprotocol = \"operation\"\nfile = \"wet.csv\"\n") {
    const sensor::ObserverParameters<double> unit = unit_parameters(type().observer->parameters, deviations);
    write_strokes(file_.folder() / "dry.csv", unit, {0, 0}, type().valve.stroke_m);
    const double way_s = slip_m > 0 ? 16 : 6, never_s = 1e9;
    write_strokes(file_.folder() / "wet.csv", unit, {40, 40}, type().valve.stroke_m, way_s, never_s, slip_m);
    std::ofstream out(file_.folder() / "type.json");
    model::write_model(out, type());
  }
  [[nodiscard]] UnitCalibration calibrate(std::string_view also = {}) const {
    const std::filesystem::path file = file_.folder() / "said.toml";
    {
      std::ifstream in(file_.path());
      std::ofstream(file) << in.rdbuf() << also;
    }
    CalibratedUnit unit = calibrate_unit(type(), (file_.folder() / "type.json").string(),
                                         recording::read_unit_campaign(file, valve_of_type(type())), "test",
                                         [](const std::string&, double) {});
    doubts_ = unit.model.provenance.doubts;
    return unit.directions.at(0);
  }
  /// About the unit that was calibrated last.
  [[nodiscard]] const std::vector<std::string>& doubts() const { return doubts_; }
  /// Every `every`-th value of that column of a recording becomes what `change` makes of it.
  void spoil(const char* recording, std::size_t column, const std::function<std::string(std::string)>& change,
             std::size_t every = 1) const {
    std::vector<std::string> lines;
    {
      std::ifstream in(file_.folder() / recording);
      for (std::string line; std::getline(in, line);) lines.push_back(line);
    }
    std::ofstream out(file_.folder() / recording);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      std::size_t from = 0;
      for (std::size_t c = 0; c < column; ++c) from = lines[k].find(',', from) + 1;
      const std::size_t to = std::min(lines[k].find(',', from), lines[k].size());
      if (k > 0 && k % every == 0) lines[k].replace(from, to - from, change(lines[k].substr(from, to - from)));
      out << lines[k] << '\n';
    }
  }
  /// Of the run under pressure.
  [[nodiscard]] std::ptrdiff_t force_rows() const {
    const recording::Recording wet = recording::read_recording(file_.folder() / "wet.csv", {});
    const UnitEvidence evidence(type(), {{&wet, recording::Protocol::operation}});
    return std::ranges::count(evidence.kinds(), EvidenceOf::force);
  }

 private:
  recording::TemporaryFile file_;
  mutable std::vector<std::string> doubts_;
};

}  // namespace spoolflow::calibration
