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
                  .evidence = "duty_cycle_1: p95 5.56, 5.21, 5.21 % FS, band 91.8, 94.2, 94.5 %"},
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
                  .evidence = "ramp_60bar_dither: p95 5.83, 5.83, 5.83 % FS, band 36.9, 43.4, 57.3 %"},
                 band.coverage_factor);
  visitor.number({.key = "band_force_share",
                  .unit = "1",
                  .limits = {1e-3, 10},
                  .meaning = "how much of the forces' errors the band counts while the spool slides",
                  .evidence = "ramp_60bar_dither: p95 5.83, 5.83, 5.83 % FS, band 41.1, 43.4, 52.9 %"},
                 band.force_share);
  visitor.number({.key = "band_rest_share",
                  .unit = "1",
                  .limits = {1e-3, 100},
                  .meaning = "how much of the forces' errors the band counts while the spool rests",
                  .evidence = "ramps_30_to_70bar: p95 0.41, 0.41, 0.41 % FS, band 91.8, 97.0, 98.2 %"},
                 band.rest_share);
  visitor.number(
      {.key = "band_tolerance_N",
       .unit = "N",
       .limits = {0, 1e4},
       .meaning = "how far friction at rest may lie outside of what the pre-sliding displacement bounds, one "
                  "standard deviation as the band counts it: friction_tolerance_N scaled by how the forces' "
                  "errors proved on operating recordings",
       .evidence = "ramp_60bar_dither: p95 5.83, 5.83, 5.83 % FS, band 42.7, 43.4, 43.8 %"},
      band.tolerance_N);
  visitor.number({.key = "band_creep_per_s",
                  .unit = "1/s",
                  .limits = {0, 10},
                  .meaning = "growth of that tolerance with the time at rest, as a share of it",
                  .evidence = "ramp_60bar_dither: p95 5.83, 5.83, 5.83 % FS, band 43.0, 43.4, 43.5 %"},
                 band.creep_per_s);
  visitor.number({.key = "band_unseen_factor",
                  .unit = "1",
                  .limits = {1e-3, 100},
                  .meaning = "standard deviation of unseen changes of pressure over the liveliest random walk",
                  .evidence = "fast_10kHz: p95 5.00, 5.00, 5.00 % FS, band 89.1, 93.0, 95.8 %"},
                 band.unseen_factor);
}

}  // namespace spoolflow::model
