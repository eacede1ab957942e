#pragma once
/// Recordings of one valve whose positions count from different zeros. What is found is taken off the positions, so
/// that other relations are judged without it.
#include <optional>
#include <span>
#include <vector>

#include "spoolflow/consistency/doubt.hpp"
#include "spoolflow/consistency/known_valve.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::consistency {

/// Axial-force maps against the others of their valve, by the flow over position; the one that stands out most first.
/// Nothing of a single map.
[[nodiscard]] std::vector<Doubt> doubts_about_zeros(const std::vector<recording::Recording*>& maps, double stroke_m);

/// The spring recording against the axial-force maps, by the axial force over position.
[[nodiscard]] std::optional<Doubt> doubt_about_zero(const recording::Recording& spring,
                                                    const std::vector<const recording::Recording*>& maps,
                                                    double stroke_m);

/// A run against the valve's maps by its flow over position, and by where its spool rests without current. `valve`: one
/// direction, or both of a whole valve whose run goes through the centre.
[[nodiscard]] std::vector<Doubt> doubts_about_zero(recording::Recording& run, std::span<const KnownValve> valve);

/// The edges of both directions of a whole valve against each other; positions count from its centre.
[[nodiscard]] std::optional<Doubt> doubt_about_centre(const OpeningCurve& b, const OpeningCurve& a, double stroke_m);

}  // namespace spoolflow::consistency
