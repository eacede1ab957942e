/// Files of strangers, end to end: what `inspect` proposes is saved, filled in only where it asks, and `estimate` then
/// answers as it does of our own file.
#include <array>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

const std::array<std::string, 5> own_names{"time_s", "current_A", "voltage_V", "position_mm", "oil_temperature_C"};

/// How a stranger writes time, current, voltage, position and oil temperature.
struct Foreign {
  std::string title;                             ///< lines above the header
  std::array<std::string, 5> names;              ///< of the columns
  std::array<double, 5> per_own{1, 1, 1, 1, 1};  ///< what s, A, V, mm, degC are multiplied by
  char delimiter = ',';
  char point = '.';
  std::string time_of_day{};           ///< in its place: "iso" or "german"
  std::array<std::string, 5> asked{};  ///< the unit to fill in where `inspect` asks
  bool utf16 = false;
  std::string missing = "";  ///< in one cell of the voltage
};

class ForeignFiles : public CommandLine {
 protected:
  static constexpr int rows = 400;

  static std::array<double, 5> own(int row) {
    const double swing = std::sin(0.02 * row);
    return {1e-3 * row, 1.2 + 0.5 * swing, 3.4 + 1.5 * swing, 1.1 + 0.9 * swing, 50};
  }

  static std::string clock(const std::string& how, double time_s) {
    const int whole = static_cast<int>(time_s);
    const int ms = static_cast<int>(std::lround(1e3 * (time_s - whole)));
    return how == "iso" ? fmt::format("2026-11-22T10:15:{:02}.{:03}", 30 + whole, ms)
                        : fmt::format("22.11.2026 10:15:{:02},{:03}", 30 + whole, ms);
  }

  static std::string text_of(const Foreign& file) {
    std::string out = file.title;
    for (std::size_t k = 0; k < 5; ++k) out += (k == 0 ? "" : std::string(1, file.delimiter)) + file.names[k];
    out += '\n';
    for (int row = 0; row < rows; ++row) {
      const std::array<double, 5> values = own(row);
      for (std::size_t k = 0; k < 5; ++k) {
        if (k > 0) out += file.delimiter;
        std::string cell = fmt::format("{:.9g}", values[k] * file.per_own[k]);
        if (const std::size_t at = cell.find('.'); at != std::string::npos) cell[at] = file.point;
        if (k == 0 && !file.time_of_day.empty()) cell = clock(file.time_of_day, values[0]);
        if (k == 2 && row == 200 && !file.missing.empty()) cell = file.missing;
        out += cell;
      }
      out += '\n';
    }
    if (!file.utf16) return out;
    std::string wide = "\xFF\xFE";
    for (const char c : out) wide += {c, '\0'};
    return wide;
  }

  /// The map that `inspect` prints, question marks answered.
  static std::string filled_in(const std::string& printed, const Foreign& file) {
    std::string out;
    std::istringstream lines(printed.substr(printed.find("[channels]")));
    for (std::string line; std::getline(lines, line);) {
      for (std::size_t k = 0; k < 5; ++k) {
        const std::size_t at = line.find("unit = \"?\"");
        if (at != std::string::npos && line.find('"' + file.names[k] + '"') != std::string::npos)
          line.replace(at, 10, "unit = \"" + file.asked[k] + '"');
      }
      out += line + '\n';
    }
    return out;
  }

  static std::vector<double> flows(const std::string& estimate) {
    std::vector<double> out;
    std::istringstream lines(estimate);
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) out.push_back(std::stod(line.substr(line.find(',') + 1)));
    return out;
  }

  const std::string model = SPOOLFLOW_EXAMPLE_MODEL;
};

std::vector<Foreign> strangers() {
  return {
      {"", {"t [ms]", "I_sol [mA]", "U_sol [mV]", "x [um]", "T_oil [degC]"}, {1e3, 1e3, 1e3, 1e3, 1}},
      {"", {"Zeit [s]", "Strom [A]", "Spannung [V]", "Weg [mm]", "Öltemperatur [°C]"}, {1, 1, 1, 1, 1}, ';', ','},
      {"",
       {"Zeit", "Strom", "Spannung", "Weg", "Öltemperatur"},
       {1, 1, 1, 1, 1},
       ';',
       ',',
       "",
       {"s", "A", "V", "mm", "C"}},
      {"", {"temps (s)", "courant (A)", "tension (V)", "course (mm)", "température huile (°C)"}},
      {"", {"tempo [s]", "corrente [A]", "tensione [V]", "corsa [mm]", "temperatura olio [C]"}},
      {"", {"tiempo [s]", "corriente [A]", "voltaje [V]", "carrera [mm]", "temperatura aceite [C]"}},
      {"", {"jikan [s]", "denryu [A]", "denatsu [V]", "ichi [mm]", "yuon [C]"}},
      {"",
       {"Time (s)", "Coil Current (mA)", "Coil Voltage (V)", "Spool Position (mm)", "Oil Temp (C)"},
       {1, 1e3, 1, 1, 1}},
      {"", {"time_s", "current_A", "voltage_V", "position_in", "oil_temperature_C"}, {1, 1, 1, 1 / 25.4, 1}},
      {"",
       {"time [s]", "current [A]", "voltage [V]", "stroke [mil]", "oil temperature [C]"},
       {1, 1, 1, 1000 / 25.4, 1}},
      {"", {"time_us", "current_mA", "voltage_mV", "position_um", "oil_temperature_C"}, {1e6, 1e3, 1e3, 1e3, 1}},
      {"", {"seconds", "i", "u", "lvdt", "temp"}, {1, 1, 1, 1, 1}, ',', '.', "", {"s", "A", "V", "mm", "C"}},
      {"Measurement 12, rig 3\nmorning\n", own_names},
      {"Prüfstand 3\nDatum;22.11.2026\n\n",
       {"Zeit [s]", "Strom [A]", "Spannung [V]", "Weg [mm]", "Temperatur [C]"},
       {1, 1, 1, 1, 1},
       ';',
       ','},
      {"",
       {"time", "current [A]", "voltage [V]", "position [mm]", "temperature [C]"},
       {1, 1, 1, 1, 1},
       ',',
       '.',
       "iso"},
      {"", {"Zeit", "Strom [A]", "Spannung [V]", "Weg [mm]", "Temperatur [C]"}, {1, 1, 1, 1, 1}, ';', ',', "german"},
      {"", own_names, {1, 1, 1, 1, 1}, '\t'},
      {"", own_names, {1, 1, 1, 1, 1}, ',', '.', "", {}, true},
      {"", own_names, {1, 1, 1, 1, 1}, ',', '.', "", {}, false, "NaN"},
      {"", own_names, {1, 1, 1, 1, 1}, ',', '.', "", {}, false, "NULL"},
      {"", own_names, {1, 1, 1, 1, 1}, ';', ',', "", {}, false, "-"},
      {"", {"log.time [s]", "log.I_coil [A]", "log.U_coil [V]", "log.spool [mm]", "log.T_oil [C]"}},
      {"", {"t_s", "i_act [A]", "u_act [V]", "x_ist [mm]", "t_oil [C]"}},
      {"sep=;\n", own_names, {1, 1, 1, 1, 1}, ';', ','},
      {"# logger 7\n", own_names}};
}

TEST_F(ForeignFiles, GoEndToEndWithWhatInspectProposesAndNoMoreThanItAsks) {
  int tried = 0;
  for (const Foreign& file : strangers()) {
    SCOPED_TRACE(file.title + file.names[0] + file.delimiter + file.names[1] + file.delimiter + file.names[3]);
    Foreign own{"", own_names};
    own.missing = file.missing;
    write("own.csv", text_of(own));
    write("foreign.csv", text_of(file));
    ASSERT_EQ(run("estimate -q " + model + " own.csv -o own_estimate.csv").status, 0);
    const Answer inspected = run("inspect foreign.csv");
    ASSERT_EQ(inspected.status, 0) << inspected.message;
    ASSERT_NE(inspected.output.find("[channels]"), std::string::npos) << inspected.output;
    write("map.toml", filled_in(inspected.output, file));
    const Answer estimated = run("estimate -q " + model + " foreign.csv --channels map.toml -o estimate.csv");
    ASSERT_EQ(estimated.status, 0) << estimated.message << inspected.output;
    const std::vector<double> expected = flows(content("own_estimate.csv")), found = flows(content("estimate.csv"));
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) ASSERT_NEAR(found[k], expected[k], 1e-3) << k;
    ++tried;
  }
  EXPECT_GE(tried, 25);
}

}  // namespace
}  // namespace spoolflow::apps
