#pragma once
#include <memory>

#include "spoolflow/model/model.hpp"
#include "spoolflow/uncertainty/disturbed_sensor.hpp"

namespace spoolflow::uncertainty {

/// Derivatives of the condensed sensor's flow rate over every quantity, by automatic differentiation through its
/// templates. Made once a model, asked at many points.
class CondensedSlopes {
 public:
  explicit CondensedSlopes(const model::Model& model);
  /// Flow [m3/s] per SI unit of each quantity.
  [[nodiscard]] PerQuantity<double> at(const sensor::Sample<double>& sample, const Surroundings& surroundings) const;

 private:
  struct Seeded;
  std::shared_ptr<const Seeded> seeded_;
};

}  // namespace spoolflow::uncertainty
