#pragma once
/// How sure the observer may be, each number described once; see parameter.hpp.
#include "spoolflow/model/parameter.hpp"

namespace spoolflow::model {

template <class Band, class Visitor>
// long: a list, one entry a parameter
void describe_band(Band& band, Visitor& visitor) {
  visitor.number({.key = "band_friction_share",
                  .unit = "1",
                  .limits = {0, 10},
                  .meaning = "standard deviation of sliding friction about its map, as a share of it",
                  .evidence = "ramps_30_to_70bar: p95 0.33, 0.33, 0.33 % FS, band 93.9, 95.1, 97.8 %"},
                 band.friction_share);
  visitor.number({.key = "band_force_residual_N",
                  .unit = "N",
                  .limits = {1e-6, 1e4},
                  .meaning = "standard deviation of all force maps together"},
                 band.force_residual_N);
  visitor.number({.key = "band_flow_residual_m3_per_s",
                  .unit = "m3/s",
                  .limits = {0, 1},
                  .meaning = "standard deviation of the flow about its map"},
                 band.flow_residual_m3_per_s);
  visitor.number({.key = "band_coverage_factor",
                  .unit = "1",
                  .limits = {0.1, 100},
                  .meaning = "standard deviations in the 95 % band",
                  .evidence = "ramps_30_to_70bar: p95 0.33, 0.33, 0.33 % FS, band 85.7, 95.1, 99.1 %"},
                 band.coverage_factor);
  visitor.number({.key = "band_force_share",
                  .unit = "1",
                  .limits = {1e-3, 10},
                  .meaning = "how much of the forces' errors the band counts while the spool slides",
                  .evidence = "ramp_60bar: p95 0.28, 0.28, 0.28 % FS, band 93.9, 97.8, 99.5 %"},
                 band.force_share);
  visitor.number({.key = "band_rest_share",
                  .unit = "1",
                  .limits = {1e-3, 100},
                  .meaning = "how much of the forces' errors the band counts while the spool rests",
                  .evidence = "ramps_30_to_70bar: p95 0.33, 0.33, 0.33 % FS, band 88.2, 95.1, 98.3 %"},
                 band.rest_share);
  visitor.number(
      {.key = "band_tolerance_N",
       .unit = "N",
       .limits = {0, 1e4},
       .meaning = "how far friction at rest may lie outside of what the pre-sliding displacement bounds, one "
                  "standard deviation as the band counts it: friction_tolerance_N scaled by how the forces' "
                  "errors proved on operating recordings",
       .evidence = "duty_cycle_1: p95 3.25, 3.29, 3.37 % FS, band 94.5, 94.8, 95.0 %"},
      band.tolerance_N);
  visitor.number({.key = "band_creep_per_s",
                  .unit = "1/s",
                  .limits = {0, 10},
                  .meaning = "growth of that tolerance with the time at rest, as a share of it",
                  .evidence = "duty_cycle_1: p95 3.27, 3.29, 3.34 % FS, band 94.7, 94.8, 94.8 %"},
                 band.creep_per_s);
  visitor.number({.key = "band_unseen_factor",
                  .unit = "1",
                  .limits = {1e-3, 100},
                  .meaning = "standard deviation of unseen changes of pressure over the liveliest random walk",
                  .evidence = "duty_cycle_1: p95 3.35, 3.29, 3.23 % FS, band 89.6, 94.8, 98.8 %"},
                 band.unseen_factor);
}

}  // namespace spoolflow::model
