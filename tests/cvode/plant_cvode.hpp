#pragma once
/// The plant's right-hand side integrated by SUNDIALS CVODE (BDF, dense Jacobian by differences): the yardstick of the
/// rig's own integrator, in tests and benchmarks only.
#include <memory>
#include <stdexcept>
#include <string>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "spoolflow/rig/plant/plant_memory.hpp"

#ifndef SUN_COMM_NULL  // SUNDIALS 7 and later have it
#define SUN_COMM_NULL nullptr
#endif

namespace spoolflow::rig::reference {

class PlantCvode {
 public:
  /// With `restart` the method restarts at every change of the input; without, it carries its history over the jump.
  PlantCvode(const PlantParameters& parameters, const PlantState& state, double relative_tolerance, bool restart = true)
      : parameters_(parameters),
        state_(state),
        constants_(plant_constants(parameters, state, PlantInput{})),
        restart_(restart) {
    check(SUNContext_Create(SUN_COMM_NULL, &context_), "SUNContext_Create");
    y_ = N_VNew_Serial(plant_states, context_);
    const N_Vector tolerance = N_VNew_Serial(plant_states, context_);
    // One part of the relative tolerance in the full scale of each state.
    const double flux = parameters.solenoid_b.circuit.iron_area_m2 * parameters.solenoid_b.iron.saturation_T;
    const double linkage = flux * parameters.solenoid_b.coil.turns;
    const double scale[plant_states] = {
        parameters.spool.stroke_m, 0.5, linkage, flux, 500.0, linkage, flux, 500.0, 1e7, 1e7, 1e7, 1e-3, 0.1, 0.1};
    for (int i = 0; i < plant_states; ++i) NV_Ith_S(tolerance, i) = relative_tolerance * scale[i];
    load();
    cvode_ = CVodeCreate(CV_BDF, context_);
    check(CVodeInit(cvode_, &PlantCvode::rate, state_.time_s, y_), "CVodeInit");
    check(CVodeSVtolerances(cvode_, relative_tolerance, tolerance), "CVodeSVtolerances");
    check(CVodeSetUserData(cvode_, this), "CVodeSetUserData");
    check(CVodeSetMaxNumSteps(cvode_, 1000000), "CVodeSetMaxNumSteps");
    matrix_ = SUNDenseMatrix(plant_states, plant_states, context_);
    solver_ = SUNLinSol_Dense(y_, matrix_, context_);
    check(CVodeSetLinearSolver(cvode_, solver_, matrix_), "CVodeSetLinearSolver");
    N_VDestroy(tolerance);
  }
  PlantCvode(const PlantCvode&) = delete;
  PlantCvode& operator=(const PlantCvode&) = delete;
  ~PlantCvode() {
    CVodeFree(&cvode_);
    SUNLinSolFree(solver_);
    SUNMatDestroy(matrix_);
    N_VDestroy(y_);
    SUNContext_Free(&context_);
  }

  /// Advances to state().time_s + dt_s with the input held; the memories are committed after each of CVODE's own steps.
  void advance(const PlantInput& input, double dt_s) {
    input_ = input;
    constants_ = plant_constants(parameters_, state_, input_);
    const double end = state_.time_s + dt_s;
    if (restart_) check(CVodeReInit(cvode_, state_.time_s, y_), "CVodeReInit");
    check(CVodeSetStopTime(cvode_, end), "CVodeSetStopTime");
    double time = state_.time_s;
    while (time < end) {
      plant_rates(parameters_, constants_, state_, input_, differential_states(state_), contact_ages(state_),
                  state_.time_s, start_);
      check(CVode(cvode_, end, y_, &time, CV_ONE_STEP), "CVode");
      PlantVector reached;
      for (int i = 0; i < plant_states; ++i) reached[i] = NV_Ith_S(y_, i);
      const double h = time - state_.time_s;
      const ContactAges ages = contact_ages(constants_, state_, start_, reached, h);
      PlantRates last;
      plant_rates(parameters_, constants_, state_, input_, reached, ages, time, last);
      PlantLosses losses;
      commit(parameters_, constants_, state_, reached, start_, last, ages, h, losses);
      state_.time_s = time;
    }
  }

  [[nodiscard]] const PlantState& state() const { return state_; }

 private:
  static int rate(double time, N_Vector y, N_Vector rate_out, void* self_pointer) {
    auto& self = *static_cast<PlantCvode*>(self_pointer);
    PlantVector u;
    for (int i = 0; i < plant_states; ++i) u[i] = NV_Ith_S(y, i);
    const double elapsed = time - self.state_.time_s;
    ContactAges ages = contact_ages(self.state_);
    if (elapsed > 0.0) ages = contact_ages(self.constants_, self.state_, self.start_, u, elapsed);
    PlantRates rates;
    plant_rates(self.parameters_, self.constants_, self.state_, self.input_, u, ages, time, rates);
    for (int i = 0; i < plant_states; ++i) NV_Ith_S(rate_out, i) = rates.rate[i];
    return 0;
  }

  void load() {
    const PlantVector u = differential_states(state_);
    for (int i = 0; i < plant_states; ++i) NV_Ith_S(y_, i) = u[i];
  }

  static void check(int status, const char* call) {
    if (status < 0) throw std::runtime_error(std::string(call) + " failed with " + std::to_string(status));
  }

  PlantParameters parameters_;
  PlantState state_;
  PlantConstants constants_;
  bool restart_;
  PlantInput input_;
  PlantRates start_{};
  SUNContext context_ = nullptr;
  void* cvode_ = nullptr;
  N_Vector y_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
};

}  // namespace spoolflow::rig::reference
