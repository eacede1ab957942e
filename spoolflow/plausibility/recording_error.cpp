#include "spoolflow/plausibility/recording_error.hpp"

#include <array>

namespace spoolflow::plausibility {
namespace {

constexpr RecordingError turned{"of the wrong sign", "its sign turned", -1};
constexpr RecordingError ten_small{"ten times too small", "it times 10", 10};
constexpr RecordingError ten_large{"ten times too large", "it divided by 10", 0.1};
constexpr RecordingError thousand_small{"a thousand times too small", "it times 1000", 1000};
constexpr RecordingError thousand_large{"a thousand times too large", "it divided by 1000", 1e-3};
constexpr RecordingError halved{"halved", "it times 2", 2};
constexpr RecordingError doubled{"doubled", "it divided by 2", 0.5};

constexpr std::array lengths{RecordingError{"reversed, counted from the other end", "the stroke less it", 1, true},
                             turned,
                             RecordingError{"in inches, not mm", "it times 25.4", 25.4},
                             RecordingError{"in mm where inches were said", "it divided by 25.4", 1 / 25.4},
                             ten_small,
                             ten_large,
                             thousand_small,
                             thousand_large,
                             halved,
                             doubled};
constexpr std::array forces{turned,
                            RecordingError{"in kgf, not N", "it times 9.80665", 9.80665},
                            RecordingError{"in lbf, not N", "it times 4.448", 4.4482216},
                            RecordingError{"in N where kgf was said", "it divided by 9.80665", 1 / 9.80665},
                            RecordingError{"in N where lbf was said", "it divided by 4.448", 1 / 4.4482216},
                            ten_small,
                            ten_large,
                            thousand_small,
                            thousand_large,
                            halved,
                            doubled};
constexpr std::array electric{turned, halved, doubled, ten_small, ten_large, thousand_small, thousand_large};
constexpr std::array pressures{turned,
                               ten_small,
                               ten_large,
                               RecordingError{"in psi, not bar", "it divided by 14.504", 1 / 14.503774},
                               RecordingError{"in bar where psi was said", "it times 14.504", 14.503774},
                               halved,
                               doubled,
                               thousand_small,
                               thousand_large};
constexpr std::array flows{turned,
                           RecordingError{"in US gal/min, not L/min", "it times 3.785", 3.785411784},
                           RecordingError{"in m3/h, not L/min", "it times 16.667", 1000.0 / 60},
                           RecordingError{"in L/s, not L/min", "it times 60", 60},
                           RecordingError{"in L/min where US gal/min was said", "it divided by 3.785", 1 / 3.785411784},
                           RecordingError{"in L/min where m3/h was said", "it divided by 16.667", 0.06},
                           RecordingError{"in L/min where L/s was said", "it divided by 60", 1.0 / 60},
                           ten_small,
                           ten_large,
                           halved,
                           doubled,
                           thousand_small,
                           thousand_large};
constexpr std::array rated{ten_small, ten_large,
                           RecordingError{"in US gal/min, not L/min", "it times 3.785", 3.785411784},
                           RecordingError{"in m3/h, not L/min", "it times 16.667", 1000.0 / 60}};

}  // namespace

std::span<const RecordingError> usual_recording_errors(recording::Channel channel) {
  using recording::Channel;
  switch (channel) {
    case Channel::position:
      return lengths;
    case Channel::force:
    case Channel::axial_force:
      return forces;
    case Channel::current:
    case Channel::current_a:
    case Channel::current_b:
    case Channel::voltage:
    case Channel::voltage_a:
    case Channel::voltage_b:
      return electric;
    case Channel::pressure_difference:
      return pressures;
    case Channel::flow:
      return flows;
    default:
      return {};
  }
}

std::span<const RecordingError> usual_errors_of_rated_flow() {
  return rated;
}

}  // namespace spoolflow::plausibility
