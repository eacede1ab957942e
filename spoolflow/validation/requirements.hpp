#pragma once
/// What a user asks of the sensor, limit by limit.
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/estimation/estimator.hpp"

namespace spoolflow::validation {

/// The figure that a limit bounds.
enum class Figure { p95, rms, largest, bias, band_mean_width, band_coverage, p95_of_reading, fault_share, wrong_sign };
/// Which samples it is taken over.
enum class When { always, moving, rest, reversal, p_to_b, p_to_a };
/// `percent`: of the samples, or of the reading.
enum class LimitUnit { percent_FS, litre_per_minute, percent };

/// Names as they are written in a requirements file.
template <class Value>
struct Named {
  Value value;
  std::string_view name;
};
inline constexpr std::array figure_names{Named<Figure>{Figure::p95, "p95"},
                                         Named<Figure>{Figure::rms, "rms"},
                                         Named<Figure>{Figure::largest, "largest"},
                                         Named<Figure>{Figure::bias, "bias"},
                                         Named<Figure>{Figure::band_mean_width, "band_mean_width"},
                                         Named<Figure>{Figure::band_coverage, "band_coverage"},
                                         Named<Figure>{Figure::p95_of_reading, "p95_of_reading"},
                                         Named<Figure>{Figure::fault_share, "fault_share"},
                                         Named<Figure>{Figure::wrong_sign, "wrong_sign"}};
inline constexpr std::array when_names{Named<When>{When::always, "always"}, Named<When>{When::moving, "moving"},
                                       Named<When>{When::rest, "rest"},     Named<When>{When::reversal, "reversal"},
                                       Named<When>{When::p_to_b, "p_to_b"}, Named<When>{When::p_to_a, "p_to_a"}};
inline constexpr std::array limit_unit_names{Named<LimitUnit>{LimitUnit::percent_FS, "% FS"},
                                             Named<LimitUnit>{LimitUnit::litre_per_minute, "L/min"},
                                             Named<LimitUnit>{LimitUnit::percent, "%"}};

template <class Value, std::size_t count>
[[nodiscard]] constexpr std::string_view name_of(const std::array<Named<Value>, count>& names, Value value) {
  for (const Named<Value>& each : names) {
    if (each.value == value) return each.name;
  }
  return "";
}

/// One line of what is asked. Of a signed figure (bias) the magnitude is bounded.
struct Limit {
  std::string place;        ///< file and line
  std::string run = "all";  ///< a run's name, "each" by itself, or "all" together
  When when = When::always;
  Figure figure = Figure::p95;
  LimitUnit unit = LimitUnit::percent_FS;
  std::optional<double> at_least = {}, at_most = {};    ///< in `unit`
  std::optional<estimation::Estimator> estimator = {};  ///< else the leading one
};

struct Requirements {
  std::string file;
  std::vector<Limit> limits;
};

/// A limit against a run. `value` is absent where it is unknown (no reference flow, no such samples); then the
/// limit counts as not met.
struct JudgedLimit {
  Limit limit;
  std::string run;  ///< "all runs", or a run's name
  estimation::Estimator estimator;
  std::optional<double> value;  ///< in the limit's unit
  bool met;
  bool calibrated_with = false;  ///< not judged: the calibration read every run that it is of
};

/// What is judged where the user asks nothing: 95 % of the errors within 5 % of full scale, and a band that holds at
/// least 93 % of the samples. 5 %: half of what the paper's condensed sensor reaches. 93 %: below it the verdict calls
/// the band too narrow. No file.
[[nodiscard]] Requirements default_requirements();

/// Throws RecordingError with file and line where the file cannot be used.
[[nodiscard]] Requirements read_requirements(const std::filesystem::path& file);

/// Throws RecordingError where a limit names a run that is not among `runs`, or an estimator that is not among
/// `estimators`.
void check_names(const Requirements& requirements, const std::vector<std::string>& runs,
                 const std::vector<estimation::Estimator>& estimators);

}  // namespace spoolflow::validation
