#pragma once
/// What goes between the firmware and the amplifiers and instruments around it, once a millisecond. Both sides are
/// little-endian with floats of 32 bits.
#include <cstdint>

/// Something that happens to the firmware beside the samples.
enum class Event : std::uint32_t {
  none = 0,
  newer_page = 1,  ///< a newer calibration of the valve comes in and is written to the page that is not at work
  bit_falls = 2    ///< a bit of the page at work falls
};

/// Means of the last millisecond; NaN where a channel is not measured.
struct Measured {
  float set_position_m;  ///< what the machine asks for, > 0 opens P to B
  float current_a_A;
  float current_b_A;
  float voltage_a_V;
  float voltage_b_V;
  float position_m;
  float oil_temperature_K;
  Event event;
};

/// What the amplifiers are to do until the next sample, and what the sensor answered.
struct Ordered {
  float current_a_A;
  float current_b_A;
  float dither_amplitude_A;  ///< on the current of the coil at work; 0: none
  float dither_frequency_Hz;
  float flow_m3_per_s;  ///< with its band; NaN while no page is at work
  float flow_lower_m3_per_s;
  float flow_upper_m3_per_s;
  std::uint32_t status;  ///< of the sensor
  std::uint32_t trust;   ///< see valve_control.hpp
  std::uint32_t page;    ///< at work: 1 or 2; 0: none
};
