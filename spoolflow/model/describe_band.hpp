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
                  .evidence = "temperature_sweep: p95 0.27, 0.27, 0.26 % FS, band 95.5, 96.9, 99.2 %"},
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
                  .evidence = "ramps_30_to_70bar: p95 0.33, 0.33, 0.33 % FS, band 85.0, 94.6, 98.5 %"},
                 band.coverage_factor);
  visitor.number({.key = "band_force_share",
                  .unit = "1",
                  .limits = {1e-3, 10},
                  .meaning = "how much of the forces' errors the band counts while the spool slides",
                  .evidence = "ramp_60bar: p95 0.28, 0.28, 0.28 % FS, band 92.6, 97.5, 99.5 %"},
                 band.force_share);
  visitor.number({.key = "band_rest_share",
                  .unit = "1",
                  .limits = {1e-3, 100},
                  .meaning = "how much of the forces' errors the band counts while the spool rests",
                  .evidence = "ramps_30_to_70bar: p95 0.33, 0.33, 0.33 % FS, band 88.1, 94.6, 97.5 %"},
                 band.rest_share);
  visitor.number(
      {.key = "band_tolerance_N",
       .unit = "N",
       .limits = {0, 1e4},
       .meaning = "how far friction at rest may lie outside of what the pre-sliding displacement bounds, one "
                  "standard deviation as the band counts it: friction_tolerance_N scaled by how the forces' "
                  "errors proved on operating recordings",
       .evidence = "duty_cycle_1: p95 3.31, 3.35, 3.42 % FS, band 94.8, 95.1, 95.3 %"},
      band.tolerance_N);
  visitor.number({.key = "band_creep_per_s",
                  .unit = "1/s",
                  .limits = {0, 10},
                  .meaning = "growth of that tolerance with the time at rest, as a share of it",
                  .evidence = "duty_cycle_1: p95 3.32, 3.35, 3.40 % FS, band 95.0, 95.1, 95.2 %"},
                 band.creep_per_s);
  visitor.number({.key = "band_unseen_factor",
                  .unit = "1",
                  .limits = {1e-3, 100},
                  .meaning = "standard deviation of unseen changes of pressure over the liveliest random walk",
                  .evidence = "duty_cycle_1: p95 3.43, 3.35, 3.27 % FS, band 89.9, 95.1, 99.0 %"},
                 band.unseen_factor);
}

}  // namespace spoolflow::model
