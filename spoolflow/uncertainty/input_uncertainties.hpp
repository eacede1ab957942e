#pragma once
/// Where the standard uncertainties of the budget's inputs come from: the model's residuals, the campaign's
/// instruments, the user, or stated defaults.
#include <optional>
#include <vector>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/uncertainty/input_quantity.hpp"

namespace spoolflow::uncertainty {

/// A figure with where it is from. Of a rectangular distribution the half width, else a standard deviation.
struct InstrumentFigure {
  double value;
  std::string source;
};

/// Instruments and oil. Absent: the model's.
struct InstrumentFigures {
  std::optional<InstrumentFigure> position_zero_m;  ///< half width
  InstrumentFigure position_gain{1e-3, "default: linearity of an LVDT, 0.1 % of the reading"};
  std::optional<InstrumentFigure> position_noise_m;  ///< standard deviation
  InstrumentFigure current_gain{2e-4, "default: shunt of 0.02 %"};
  InstrumentFigure current_offset_A{1e-3, "default: input offset over the shunt"};
  InstrumentFigure current_noise_A{5e-4, "default: mean over 1 ms of conversions at 10 kHz"};  ///< standard deviation
  InstrumentFigure voltage_offset_V{5e-3, "default: divider and converter"};
  InstrumentFigure thermometer_K{0.3, "default: Pt100 class A with its lag"};
  std::optional<InstrumentFigure> oil_temperature_away_K;  ///< half width; of the oil about its map's temperature
  InstrumentFigure load_cell{1e-3, "default: load cell of 0.1 %"};
  InstrumentFigure flow_meter{5e-3, "default: gear meter of 0.5 % of the reading"};
  InstrumentFigure oil_density{1e-2, "default: batches of one grade, 1 %"};
  InstrumentFigure oil_viscosity{0.1, "default: ISO 3448, 10 % within a grade"};
  bool one_load_cell = false;  ///< both benches used the same: its gain error is common to both maps
};

struct Inputs {
  std::vector<InputUncertainty> uncertainties;  ///< in the order of InputQuantity; what does not apply is left out
  std::vector<Correlation> correlations;
};

/// What an estimator's budget has for inputs. Type A figures are the model's residuals.
[[nodiscard]] Inputs inputs_of(const model::Model& model, estimation::Estimator estimator,
                               const InstrumentFigures& figures);

}  // namespace spoolflow::uncertainty
