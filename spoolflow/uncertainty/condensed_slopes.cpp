#include "spoolflow/uncertainty/condensed_slopes.hpp"

#include "spoolflow/numerics/dual.hpp"

namespace spoolflow::uncertainty {
namespace {

using Scalar = numerics::Dual<static_cast<int>(quantity_count)>;

/// Every error zero, each its own direction.
InputErrors<Scalar> directions() {
  InputErrors<Scalar> out;
  for (std::size_t k = 0; k < quantity_count; ++k) out.values[k].slope[k] = 1;
  return out;
}

}  // namespace

struct CondensedSlopes::Seeded {
  InputErrors<Scalar> error;
  sensor::CondensedParameters<Scalar> valve;
};

CondensedSlopes::CondensedSlopes(const model::Model& model)
    : seeded_(
          std::make_shared<Seeded>(Seeded{directions(), disturbed<Scalar>(model.condensed.parameters, directions())})) {
}

PerQuantity<double> CondensedSlopes::at(const sensor::Sample<double>& sample, const Surroundings& surroundings) const {
  sensor::CondensedState<Scalar> state;
  const sensor::Sample<Scalar> read = disturbed(sample, surroundings, seeded_->error);
  const auto tables = std::make_unique<sensor::CondensedTables<Scalar>>();
  sensor::lay_out_at(seeded_->valve, read.position_m, *tables);
  const Scalar flow =
      sensor::step(*tables, state, read).flow_m3_per_s - unseen_flow_m3_per_s(surroundings, seeded_->error);
  return {flow.slope};
}

}  // namespace spoolflow::uncertainty
