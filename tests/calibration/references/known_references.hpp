#pragma once
/// References of virtual valves, and the log's beginning.
#include <string>

#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/references.hpp"

namespace spoolflow::calibration {

/// The example's model; positions of the virtual unit are free of drift.
inline model::Model model_without_drift() {
  model::Model out = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
  out.observer->parameters.position_sensor.drift_m_per_K = 0;
  return out;
}

inline recording::Reference meter(double uncertainty = 0.01) {
  recording::Reference out;
  out.kind = recording::ReferenceKind::meter;
  out.name = "meter";
  out.place = "references.toml, line 1";
  out.share_uncertainty = uncertainty;
  out.leakage_uncertainty_m3_per_s = 1e-6;
  out.interval_s = 2;
  return out;
}

inline recording::Reference closed() {
  recording::Reference out;
  out.kind = recording::ReferenceKind::closed;
  out.name = "closed";
  return out;
}

inline model::Adaptation how() {
  return {"1.2.3", "2026-01-02T03:04:05Z", std::string(64, 'a'), {}, {}};
}

}  // namespace spoolflow::calibration
