/// FMI 2.0: functions that every FMU must have and this one does not offer, because modelDescription.xml says so.
#include "spoolflow/export/fmu/exported.hpp"
#include "spoolflow/export/fmu/fmi2_instance.hpp"

using spoolflow::exports::fmu::not_offered_in_fmi2;
using std::size_t;

SPOOLFLOW_FMI fmi2Status fmi2GetDirectionalDerivative(fmi2Component component, const fmi2ValueReference[], size_t,
                                                      const fmi2ValueReference[], size_t, const fmi2Real[],
                                                      fmi2Real[]) {
  return not_offered_in_fmi2(component, "fmi2GetDirectionalDerivative");
}

SPOOLFLOW_FMI fmi2Status fmi2SetRealInputDerivatives(fmi2Component component, const fmi2ValueReference[], size_t,
                                                     const fmi2Integer[], const fmi2Real[]) {
  return not_offered_in_fmi2(component, "fmi2SetRealInputDerivatives");
}

SPOOLFLOW_FMI fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component, const fmi2ValueReference[], size_t,
                                                      const fmi2Integer[], fmi2Real[]) {
  return not_offered_in_fmi2(component, "fmi2GetRealOutputDerivatives");
}

SPOOLFLOW_FMI fmi2Status fmi2CancelStep(fmi2Component component) {
  return not_offered_in_fmi2(component, "fmi2CancelStep");
}

// Model exchange.

SPOOLFLOW_FMI fmi2Status fmi2EnterEventMode(fmi2Component component) {
  return not_offered_in_fmi2(component, "fmi2EnterEventMode");
}

SPOOLFLOW_FMI fmi2Status fmi2NewDiscreteStates(fmi2Component component, fmi2EventInfo*) {
  return not_offered_in_fmi2(component, "fmi2NewDiscreteStates");
}

SPOOLFLOW_FMI fmi2Status fmi2EnterContinuousTimeMode(fmi2Component component) {
  return not_offered_in_fmi2(component, "fmi2EnterContinuousTimeMode");
}

SPOOLFLOW_FMI fmi2Status fmi2CompletedIntegratorStep(fmi2Component component, fmi2Boolean, fmi2Boolean*, fmi2Boolean*) {
  return not_offered_in_fmi2(component, "fmi2CompletedIntegratorStep");
}

SPOOLFLOW_FMI fmi2Status fmi2SetTime(fmi2Component component, fmi2Real) {
  return not_offered_in_fmi2(component, "fmi2SetTime");
}

SPOOLFLOW_FMI fmi2Status fmi2SetContinuousStates(fmi2Component component, const fmi2Real[], size_t) {
  return not_offered_in_fmi2(component, "fmi2SetContinuousStates");
}

SPOOLFLOW_FMI fmi2Status fmi2GetDerivatives(fmi2Component component, fmi2Real[], size_t) {
  return not_offered_in_fmi2(component, "fmi2GetDerivatives");
}

SPOOLFLOW_FMI fmi2Status fmi2GetEventIndicators(fmi2Component component, fmi2Real[], size_t) {
  return not_offered_in_fmi2(component, "fmi2GetEventIndicators");
}

SPOOLFLOW_FMI fmi2Status fmi2GetContinuousStates(fmi2Component component, fmi2Real[], size_t) {
  return not_offered_in_fmi2(component, "fmi2GetContinuousStates");
}

SPOOLFLOW_FMI fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component component, fmi2Real[], size_t) {
  return not_offered_in_fmi2(component, "fmi2GetNominalsOfContinuousStates");
}
