#pragma once
/// Angle of the jet behind a metering edge, from the spool axis, by opening o and clearance c (von Mises; Merritt
/// 1967):
///
///     o/c = [1 + pi/2 sin e - ln tan((pi - e)/2) cos e] / [1 + pi/2 cos e - ln tan((pi/2 + e)/2) sin e]
///
/// 21.1 deg at o << c, 45 deg at o = c, 68.9 deg at o >> c. The inverse is taken from a fit that keeps the exchange of
/// opening and clearance (e -> 90 deg - e): with y = (o - c)/(o + c), tan(e - 45 deg) = y (a0 + a1 y^2 + a2 y^4 + a3
/// y^6), within 0.004 deg of the exact angle over the whole range (the coefficients' residual; checked by a test).
#include "spoolflow/rig/numerics/scalar.hpp"

namespace spoolflow::rig {

template <class Scalar>
struct JetDirectionOf {
  Scalar cosine;
  Scalar sine;
};
using JetDirection = JetDirectionOf<double>;

template <class Scalar>
inline JetDirectionOf<Scalar> jet_direction(Scalar opening_m, Scalar clearance_m) {
  const Scalar y = (opening_m - clearance_m) / (opening_m + clearance_m);
  const Scalar y2 = y * y;
  const Scalar t = y * (0.54390398 + y2 * (-0.14449791 + y2 * (0.05774067 - 0.01473432 * y2)));
  const Scalar scale = 1.0 / square_root(2.0 * (1.0 + t * t));
  return {(1.0 - t) * scale, (1.0 + t) * scale};
}

}  // namespace spoolflow::rig
