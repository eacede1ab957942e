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
                  .evidence = "ramps_30_to_70bar: p95 0.32, 0.32, 0.33 % FS, band 94.5, 95.7, 98.1 %"},
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
                  .evidence = "ramps_30_to_70bar: p95 0.32, 0.32, 0.32 % FS, band 86.3, 95.7, 99.1 %"},
                 band.coverage_factor);
  visitor.number({.key = "band_force_share",
                  .unit = "1",
                  .limits = {1e-3, 10},
                  .meaning = "how much of the forces' errors the band counts while the spool slides",
                  .evidence = "ramp_60bar: p95 0.30, 0.30, 0.30 % FS, band 93.7, 97.7, 99.5 %"},
                 band.force_share);
  visitor.number({.key = "band_rest_share",
                  .unit = "1",
                  .limits = {1e-3, 100},
                  .meaning = "how much of the forces' errors the band counts while the spool rests",
                  .evidence = "ramps_30_to_70bar: p95 0.32, 0.32, 0.32 % FS, band 88.8, 95.7, 98.3 %"},
                 band.rest_share);
  visitor.number(
      {.key = "band_tolerance_N",
       .unit = "N",
       .limits = {0, 1e4},
       .meaning = "how far friction at rest may lie outside of what the pre-sliding displacement bounds, one "
                  "standard deviation as the band counts it: friction_tolerance_N scaled by how the forces' "
                  "errors proved on operating recordings",
       .evidence = "duty_cycle_1: p95 3.27, 3.31, 3.37 % FS, band 96.5, 96.8, 97.1 %"},
      band.tolerance_N);
  visitor.number({.key = "band_creep_per_s",
                  .unit = "1/s",
                  .limits = {0, 10},
                  .meaning = "growth of that tolerance with the time at rest, as a share of it",
                  .evidence = "duty_cycle_1: p95 3.28, 3.31, 3.35 % FS, band 96.7, 96.8, 97.0 %"},
                 band.creep_per_s);
  visitor.number({.key = "band_unseen_factor",
                  .unit = "1",
                  .limits = {1e-3, 100},
                  .meaning = "standard deviation of unseen changes of pressure over the liveliest random walk",
                  .evidence = "duty_cycle_1: p95 3.36, 3.31, 3.21 % FS, band 91.7, 96.8, 99.4 %"},
                 band.unseen_factor);
}

}  // namespace spoolflow::model
