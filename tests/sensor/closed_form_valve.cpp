/// Steps of 10 us in their millions: compiled apart, so that they are optimised where the tests are not.
#include "tests/sensor/closed_form_valve.hpp"

namespace spoolflow::sensor {

std::vector<ValveSample> ClosedFormRun::sampled(double duration_s, double sample_step_s) {
  std::vector<ValveSample> out;
  const int fine_steps = std::max(1, static_cast<int>(std::lround(sample_step_s / fine_step_s)));
  const auto samples = static_cast<int>(duration_s / sample_step_s);
  start(course_(0));
  for (int k = 0; k < samples; ++k) {
    double current_A = 0, voltage_V = 0;
    ValveInstant now{};
    for (int fine = 0; fine < fine_steps; ++fine) {
      now = course_((k + (fine + 1.0) / fine_steps) * sample_step_s);
      advance(now, sample_step_s / fine_steps);
      const double backlash_m = instruments_.position_backlash_m;
      dragged_m_ = std::clamp(dragged_m_, now.position_m - backlash_m, now.position_m + backlash_m);
      current_A += coil_A_ / fine_steps;
      voltage_V += (ClosedFormValve::resistance_Ohm * coil_A_ + flux_rate_V_) / fine_steps;
    }
    const double drift_m = ClosedFormValve::drift_m_per_K * (now.oil_temperature_K - ClosedFormValve::drift_free_K);
    out.push_back({{sample_step_s, current_A + instruments_.current_noise_A * noise_(generator_), voltage_V,
                    dragged_m_ + drift_m + instruments_.position_noise_m * noise_(generator_), now.oil_temperature_K},
                   now,
                   valve_.flow_m3_per_s(now.position_m, now.pressure_difference_Pa, now.oil_temperature_K),
                   friction_N_,
                   force_N_,
                   magnetising_A_,
                   flux_Wb_});
  }
  return out;
}

void ClosedFormRun::balance(const ValveInstant& now) {
  const double x = now.position_m;
  const double share = instruments_.friction_ratio * now.friction_share;
  const double spool_N = ClosedFormValve::spool_friction_N(now.pressure_difference_Pa, now.oil_temperature_K);
  const double steady_N = ClosedFormValve::spring_N(x) + ClosedFormValve::flow_force_N(x, now.pressure_difference_Pa);
  const double at_zero_N = ClosedFormValve::armature_friction_N(0);
  const double per_A = ClosedFormValve::armature_friction_N(1) - at_zero_N;
  magnetising_A_ = (steady_N + share * (spool_N + at_zero_N)) / (valve_.force_per_current_N_per_A(x) - share * per_A);
  force_N_ = valve_.force_per_current_N_per_A(x) * magnetising_A_;
  friction_N_ = force_N_ - steady_N;
}

void ClosedFormRun::start(const ValveInstant& now) {
  balance(now);
  flux_Wb_ = 0;
  stop_Wb_.fill(0);
  move_flux(valve_.flux_per_current_Wb_per_A(now.position_m) * magnetising_A_);
}

void ClosedFormRun::move_flux(double flux_Wb) {
  for (int k = 0; k < ClosedFormValve::stops; ++k) {
    double& stop_Wb = stop_Wb_[static_cast<unsigned>(k)];
    stop_Wb =
        std::clamp(stop_Wb + flux_Wb - flux_Wb_, -ClosedFormValve::threshold_Wb(k), ClosedFormValve::threshold_Wb(k));
  }
  flux_Wb_ = flux_Wb;
}

void ClosedFormRun::advance(const ValveInstant& now, double step_s) {
  balance(now);
  const double before_Wb = flux_Wb_;
  move_flux(valve_.flux_per_current_Wb_per_A(now.position_m) * magnetising_A_);
  flux_rate_V_ = (flux_Wb_ - before_Wb) / step_s;
  double hysteresis_A = 0;
  for (const double stop_Wb : stop_Wb_) hysteresis_A += valve_.stiffness_A_per_Wb() * stop_Wb;
  coil_A_ = magnetising_A_ + hysteresis_A + ClosedFormValve::eddy_A_per_V * flux_rate_V_;
}

}  // namespace spoolflow::sensor
