#pragma once
/// Limits of the relations, above what valves A and W and the rig's valves have, worn ones among them.
namespace spoolflow::plausibility {

inline constexpr double force_residual_share = 0.06;      ///< of the range of forces
inline constexpr double flow_residual_share = 0.04;       ///< of the largest flow
inline constexpr double usual_jet_momentum = 0.35;        ///< nearly cos 69 deg; notches and compensated spools differ
inline constexpr double jet_momentum_factor = 2.5;        ///< either way
inline constexpr double set_pressure_factor = 1.4;        ///< either way
inline constexpr double rated_flow_factor = 3;            ///< either way: makers rate at 10 or 70 bar
inline constexpr double resistance_factor = 1.45;         ///< in one campaign: copper is so much higher 115 K warmer
inline constexpr double run_resistance_factor = 1.6;      ///< between a campaign and a run, colder or warmer
inline constexpr double balance_share = 0.06;             ///< of the range of axial forces, and
inline constexpr double balance_frictions = 1.3;          ///< half widths of the spool's friction
inline constexpr double run_flow_factor = 1.13;           ///< either way
inline constexpr double run_flow_residual_share = 0.05;   ///< of the largest flow
inline constexpr double outside_share = 0.1;              ///< of positions beyond the stroke, and
inline constexpr double outside_share_of_carriage = 0.6;  ///< where a carriage moves the armature
inline constexpr double shortest_metered_s = 2.5;         ///< five lags of the slowest meter
inline constexpr double least_flow = 0.2;                 ///< share of the largest one from which a meter is compared
inline constexpr double least_opening = 0.1;  ///< share of the stroke from which forces and flow are compared
inline constexpr double least_blocks = 50;
inline constexpr double position_noise_factor = 2.5;  ///< more than in the campaign; below, slow motion is seen
inline constexpr double position_step_noises = 4;     ///< steps of a position signal over the campaign's noise
inline constexpr double hottest_usual_oil_K = 353;    ///< machines cool it at 70 degC
inline constexpr double coldest_oil_K = 233;          ///< no hydraulic oil flows
inline constexpr double usual_distance_K = 20;        ///< of a run's oil from what its valve was calibrated at
inline constexpr double frozen_share = 0.4;           ///< of a recording: a channel that repeats one value for so long
inline constexpr double frozen_beside_share = 0.3;    ///< of its range: so far goes meanwhile what moves that channel
inline constexpr double shortest_frozen_oil_s = 30;   ///< a thermometer of 0.1 K shows a change within it
inline constexpr double shortest_round_oil_s = 180;   ///< one of 0.5 K or 1 K does
inline constexpr double fewest_oil_changes = 20;      ///< that the campaign's thermometer shows in such a time
inline constexpr double one_signal_correlation = 0.98;  ///< of both coils; sound runs have -0.9 to -0.8
inline constexpr double signed_current_share = 0.1;     ///< of the largest current
inline constexpr double signed_blocks_share = 0.05;     ///< of a run on either side of zero
inline constexpr double longest_shift_s = 10;           ///< between two recorders that is looked for
inline constexpr double longest_shift_block_s = 0.5;    ///< coarser blocks show none
inline constexpr double earliest_meter_s = -0.2;        ///< blocks, and filters of the other channels
inline constexpr double latest_meter_s = 0.75;          ///< dead time and lag of the slowest meter
inline constexpr double most_unexplained = 0.25;        ///< RMS over that of the reference, once it is shifted
inline constexpr double most_shifted_share = 0.5;       ///< of what the best usual meter leaves
inline constexpr double zero_share = 0.02;              ///< of the stroke, of an offset between zeros; sound ones 0.5 %
inline constexpr double spring_zero_share = 0.03;       ///< the same by the springs' force; sound ones 1.1 %
inline constexpr double centre_share = 0.03;            ///< between the edges of both directions; sound ones 2 %
inline constexpr double most_zero_share = 0.5;          ///< of what flows leave without the offset
inline constexpr double most_zero_residual = 0.05;      ///< of the RMS of the flows, with it
inline constexpr double line_over_neighbours = 10;      ///< power of a spectrum's line; sound runs have 2, short ones 6
inline constexpr double beside_dither = 2.5;            ///< of the position's noise; without dither a line of 1 shows
inline constexpr double beat_share = 1e-3;              ///< of the largest current
inline constexpr double beat_beside_dither = 4e-3;      ///< the same; dither and the pump mix to 2.5e-3
inline constexpr double clipped_share = 1e-3;           ///< of a recording's samples, at its highest or lowest value
inline constexpr double fewest_clipped = 20;            ///< such samples
inline constexpr double most_repeated_share = 0.3;      ///< of samples like the one before, elsewhere
inline constexpr double least_reversal_share = 0.1;     ///< of changes that go back; of white noise two thirds
inline constexpr double near_zero_share = 0.02;         ///< of the largest value: pump or coil is off
inline constexpr double least_motion_correlation = 0.45;  ///< of changes of current and position, over ten seconds
inline constexpr double widest_motion_peak_s = 0.3;       ///< of shifts at which they are nearly as large
inline constexpr double agreeing_share = 0.6;             ///< of such pieces, and
inline constexpr double same_delay_s = 0.035;             ///< apart
inline constexpr double earliest_motion_s = -0.055;  ///< of a position behind its current; sound runs have 0 to 0.09
inline constexpr double latest_motion_s = 0.15;
inline constexpr double surely = 1.5;  ///< times a limit: no valve does that
inline constexpr double impossible = 10;

}  // namespace spoolflow::plausibility
