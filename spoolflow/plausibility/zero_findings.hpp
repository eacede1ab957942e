#pragma once
/// Recordings of one valve whose positions count from different zeros. What is found is taken off the positions, so
/// that other relations are judged without it.
#include <optional>
#include <span>
#include <vector>

#include "spoolflow/plausibility/finding.hpp"
#include "spoolflow/plausibility/known_valve.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

/// Axial-force maps against the others of their valve, by the flow over position; the one that stands out most first.
/// Nothing of a single map.
[[nodiscard]] std::vector<Finding> zero_findings(const std::vector<recording::Recording*>& maps, double stroke_m);

/// The spring recording against the axial-force maps, by the axial force over position.
[[nodiscard]] std::optional<Finding> spring_zero_finding(const recording::Recording& spring,
                                                         const std::vector<const recording::Recording*>& maps,
                                                         double stroke_m);

/// A run against the valve's maps by its flow over position, and by where its spool rests without current. `valve`: one
/// direction, or both of a whole valve whose run goes through the centre.
[[nodiscard]] std::vector<Finding> run_zero_findings(recording::Recording& run, std::span<const KnownValve> valve);

/// What the meter shows steadily, a second long at least, where the spool has covered the edge for half a second, if
/// that is no leakage of a sound valve.
[[nodiscard]] std::optional<Finding> meter_zero_finding(const recording::Recording& run,
                                                        std::span<const KnownValve> valve);

/// The edges of both directions of a whole valve against each other; positions count from its centre.
[[nodiscard]] std::optional<Finding> centre_finding(const OpeningCurve& b, const OpeningCurve& a, double stroke_m);

}  // namespace spoolflow::plausibility
