#pragma once
/// Everything known about one valve: what `calibrate` writes and every other command reads.
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/model/evidence.hpp"
#include "spoolflow/model/model_error.hpp"
#include "spoolflow/model/provenance.hpp"
#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::model {

inline constexpr int model_version = 1;

/// How units differ in one direction of physics, and where this one lies.
struct UnitDeviation {
  std::string name;    ///< "spring_rate", …
  std::string unit;    ///< "1" for shares, "m", or "ln" of a natural logarithm
  double tolerance;    ///< one standard deviation between units, > 0
  double value;        ///< of this unit against the type; 0 in a type's model
  double uncertainty;  ///< one standard deviation of it; the tolerance in a type's model
};

/// Entries of the environment, and of friction its breakaway_share, as they are of a unit that is known altogether; the
/// units' spread is added to them.
struct EnvironmentWithoutSpread {
  double force_N;
  double friction_share;
  double flow_share;
  double breakaway_share;  ///< 0 where the file states none
};

/// What a model says of the type that its valve is one unit of.
struct TypeSection {
  std::string name;   ///< of the type
  bool unit = false;  ///< the model is of one unit, calibrated from its own recordings; else of any of the type
  std::vector<UnitDeviation> deviations;
  std::vector<double> correlation;  ///< of what is known, row after row
  EnvironmentWithoutSpread environment{};
};

struct Valve {
  std::string name;
  double rated_flow_m3_per_s;  ///< full scale of every % FS figure
  double stroke_m;
  std::string direction;                    ///< "b": flow P to B; "a": flow P to A; "both": the whole valve
  std::optional<double> load_area_ratio{};  ///< of the cylinder it is for, port A over port B; absent: equal flows
  std::optional<double> open_stop_m{};     ///< what the position shows where the spool meets its open stop, as declared
  std::optional<double> moving_mass_kg{};  ///< spool, push rod and armature together, as declared
};

/// Data-sheet values; absent where the campaign does not give them.
struct Fluid {
  std::string name;
  std::optional<double> density_15C_kg_per_m3;
  std::optional<double> viscosity_40C_m2_per_s;
  std::optional<double> viscosity_100C_m2_per_s;
};

/// What the instruments of the campaign were good for, as 95 % uncertainties; absent where the campaign does not say.
struct Instruments {
  std::optional<double> position_m;
  std::optional<double> current_A;
  std::optional<double> force_N;
  std::optional<double> pressure_Pa;
  std::optional<double> temperature_K;
  bool operator==(const Instruments&) const = default;
};

struct Range {
  double lower;
  double upper;
};

/// How well one fit holds on the samples it was made from.
struct Residual {
  std::string of;    ///< "magnetic force", …
  std::string unit;  ///< SI
  double rms;
  double largest;
};

/// A parameter as fitted.
struct FittedParameter {
  std::string name;  ///< with its SI unit as suffix
  double value;
  double uncertainty;  ///< one standard deviation, from the fit's residual; 0 where the fit held it at its bound
};

/// What one least-squares fit knows of its parameters.
struct Fit {
  std::string of;  ///< "coil and flux linkage", …
  std::vector<FittedParameter> parameters;
  std::vector<double> correlation;  ///< square and symmetric, row after row, -1 to 1, in the order of `parameters`
};

/// The condensed sensor (paper section 3) with the range that it was measured over.
struct Condensed {
  sensor::CondensedParameters<double> parameters;
  Range current_A;
  Range position_m;
  Range pressure_difference_Pa;
  std::optional<double> oil_temperature_K;  ///< of the flow-force map; absent where it was not recorded
  std::vector<Residual> residuals;
};

/// Among an observer's defaults: A and B were joined on the bench, and the load passes unequal flows over both edges.
inline constexpr const char* each_edge_alone = "each edge by itself: both are taken as alike";

/// The pressure difference up to which a model answers, over the highest that was calibrated, where nobody declares it:
/// flow force in proportion to the pressure difference holds so far (paper (2)).
inline constexpr double usual_highest_pressure_ratio = 1.2;
/// Whether an environment declares a higher pressure difference than that.
[[nodiscard]] inline bool declares_pressure(const sensor::ObserverParameters<double>& valve) {
  constexpr double rounding = 1.01;
  return valve.highest_pressure_difference_Pa() >
         rounding * usual_highest_pressure_ratio * valve.edge.highest_pressure_difference_Pa();
}

/// The full sensor; a model may lack it.
struct Observer {
  sensor::ObserverParameters<double> parameters;
  Range oil_temperature_K;
  std::vector<Residual> residuals;
  std::vector<Fit> fits;              ///< may be empty
  std::vector<std::string> defaults;  ///< what no recording showed, and was assumed
};

/// One direction of flow of a whole valve.
struct Direction {
  Condensed condensed;
  std::optional<Observer> observer;
  Evidence evidence;
  std::optional<TypeSection> type{};
};

struct Model {
  Valve valve;
  Fluid fluid;
  Instruments instruments;
  Provenance provenance;
  Condensed condensed;
  std::optional<Observer> observer;  ///< absent: not calibrated
  Evidence evidence;
  std::optional<TypeSection> type;  ///< absent: of one valve, by its own campaign; of a whole valve one a direction
  std::optional<Direction> p_to_a;  ///< of a whole valve; what stands above is then its other direction, P to B

  [[nodiscard]] bool whole() const { return p_to_a.has_value(); }
  [[nodiscard]] bool has_observer() const { return observer && (!p_to_a || p_to_a->observer); }
};

/// The model of one direction, "a" or "b", of a whole valve; a model of one direction is its own.
[[nodiscard]] Model of_direction(const Model& model, const std::string& direction);
/// Puts a model of one direction in the place of that of a whole valve; of one direction it takes the model's place.
/// Valve and provenance stay.
void put_direction(Model& model, const std::string& direction, Model of_one);
/// "P to B" of "b", "P to A" of "a".
[[nodiscard]] const char* flow_of(const std::string& direction);
/// "b" and "a" of a whole valve, else its own.
[[nodiscard]] std::vector<std::string> directions(const Model& model);

/// Writes the versioned JSON file.
void write_model(std::ostream& out, const Model& model);
/// Reads and validates. Throws ModelError with the file and the JSON path: damaged JSON, another version, a missing or
/// unknown-typed entry, a number that is not finite or out of range, an axis that does not rise in equal steps.
[[nodiscard]] Model read_model(const std::filesystem::path& file);
/// The same from text; `file` names it in messages.
[[nodiscard]] Model parse_model(const std::string& text, const std::string& file);

}  // namespace spoolflow::model
