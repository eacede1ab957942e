#pragma once
#include "spoolflow/uncertainty/disturbed_sensor.hpp"
#include "spoolflow/uncertainty/seeded_numbers.hpp"

namespace spoolflow::uncertainty {

/// Errors of which each sample has noise of its own: `error` holds the noises' standard deviations.
class NoisyErrors {
 public:
  /// Keeps a reference to the numbers.
  NoisyErrors(const InputErrors<double>& error, SeededNumbers& numbers)
      : now_(error),
        position_m_(error[InputQuantity::position_noise]),
        current_A_(error[InputQuantity::current_noise]),
        numbers_(numbers) {}
  /// Those of the next sample.
  const InputErrors<double>& next() {
    now_[InputQuantity::position_noise] = position_m_ == 0 ? 0 : position_m_ * numbers_.normal();
    now_[InputQuantity::current_noise] = current_A_ == 0 ? 0 : current_A_ * numbers_.normal();
    return now_;
  }

 private:
  InputErrors<double> now_;
  double position_m_, current_A_;
  SeededNumbers& numbers_;
};

}  // namespace spoolflow::uncertainty
