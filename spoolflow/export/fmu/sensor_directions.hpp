#pragma once

namespace spoolflow::exports::fmu {

/// The parameters of a whole valve's two directions.
template <class Parameters>
struct BothDirections {
  Parameters b;  ///< flow P to B
  Parameters a;  ///< flow P to A
};

}  // namespace spoolflow::exports::fmu
