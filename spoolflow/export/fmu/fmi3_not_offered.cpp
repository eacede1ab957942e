/// FMI 3.0: functions that every FMU must have and this one does not offer, because modelDescription.xml says so.
#include "spoolflow/export/fmu/exported.hpp"
#include "spoolflow/export/fmu/fmi3_instance.hpp"

using spoolflow::exports::fmu::Fmi3Instance;
using spoolflow::exports::fmu::not_offered_in_fmi3;
using std::size_t;

namespace {

/// An instance of a kind that this FMU is not.
fmi3Instance refused(fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger) {
  Fmi3Instance(environment, logger).log(fmi3Error, "logStatusError", "this FMU offers co-simulation only");
  return nullptr;
}

}  // namespace

SPOOLFLOW_FMI fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                                        fmi3InstanceEnvironment environment,
                                                        fmi3LogMessageCallback logger) {
  return refused(environment, logger);
}

SPOOLFLOW_FMI fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                                             fmi3Boolean, fmi3InstanceEnvironment environment,
                                                             fmi3LogMessageCallback logger, fmi3ClockUpdateCallback,
                                                             fmi3LockPreemptionCallback, fmi3UnlockPreemptionCallback) {
  return refused(environment, logger);
}

SPOOLFLOW_FMI fmi3Status fmi3EnterEventMode(fmi3Instance handle) {
  return not_offered_in_fmi3(handle, "fmi3EnterEventMode");
}

SPOOLFLOW_FMI fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance handle, fmi3ValueReference, size_t*) {
  return not_offered_in_fmi3(handle, "fmi3GetNumberOfVariableDependencies");
}

SPOOLFLOW_FMI fmi3Status fmi3GetVariableDependencies(fmi3Instance handle, fmi3ValueReference, size_t[],
                                                     fmi3ValueReference[], size_t[], fmi3DependencyKind[], size_t) {
  return not_offered_in_fmi3(handle, "fmi3GetVariableDependencies");
}

SPOOLFLOW_FMI fmi3Status fmi3GetDirectionalDerivative(fmi3Instance handle, const fmi3ValueReference[], size_t,
                                                      const fmi3ValueReference[], size_t, const fmi3Float64[], size_t,
                                                      fmi3Float64[], size_t) {
  return not_offered_in_fmi3(handle, "fmi3GetDirectionalDerivative");
}

SPOOLFLOW_FMI fmi3Status fmi3GetAdjointDerivative(fmi3Instance handle, const fmi3ValueReference[], size_t,
                                                  const fmi3ValueReference[], size_t, const fmi3Float64[], size_t,
                                                  fmi3Float64[], size_t) {
  return not_offered_in_fmi3(handle, "fmi3GetAdjointDerivative");
}

SPOOLFLOW_FMI fmi3Status fmi3EnterConfigurationMode(fmi3Instance handle) {
  return not_offered_in_fmi3(handle, "fmi3EnterConfigurationMode");
}

SPOOLFLOW_FMI fmi3Status fmi3ExitConfigurationMode(fmi3Instance handle) {
  return not_offered_in_fmi3(handle, "fmi3ExitConfigurationMode");
}

SPOOLFLOW_FMI fmi3Status fmi3GetOutputDerivatives(fmi3Instance handle, const fmi3ValueReference[], size_t,
                                                  const fmi3Int32[], fmi3Float64[], size_t) {
  return not_offered_in_fmi3(handle, "fmi3GetOutputDerivatives");
}

// Clocks and events.

SPOOLFLOW_FMI fmi3Status fmi3GetIntervalDecimal(fmi3Instance handle, const fmi3ValueReference[], size_t, fmi3Float64[],
                                                fmi3IntervalQualifier[]) {
  return not_offered_in_fmi3(handle, "fmi3GetIntervalDecimal");
}

SPOOLFLOW_FMI fmi3Status fmi3GetIntervalFraction(fmi3Instance handle, const fmi3ValueReference[], size_t, fmi3UInt64[],
                                                 fmi3UInt64[], fmi3IntervalQualifier[]) {
  return not_offered_in_fmi3(handle, "fmi3GetIntervalFraction");
}

SPOOLFLOW_FMI fmi3Status fmi3GetShiftDecimal(fmi3Instance handle, const fmi3ValueReference[], size_t, fmi3Float64[]) {
  return not_offered_in_fmi3(handle, "fmi3GetShiftDecimal");
}

SPOOLFLOW_FMI fmi3Status fmi3GetShiftFraction(fmi3Instance handle, const fmi3ValueReference[], size_t, fmi3UInt64[],
                                              fmi3UInt64[]) {
  return not_offered_in_fmi3(handle, "fmi3GetShiftFraction");
}

SPOOLFLOW_FMI fmi3Status fmi3SetIntervalDecimal(fmi3Instance handle, const fmi3ValueReference[], size_t,
                                                const fmi3Float64[]) {
  return not_offered_in_fmi3(handle, "fmi3SetIntervalDecimal");
}

SPOOLFLOW_FMI fmi3Status fmi3SetIntervalFraction(fmi3Instance handle, const fmi3ValueReference[], size_t,
                                                 const fmi3UInt64[], const fmi3UInt64[]) {
  return not_offered_in_fmi3(handle, "fmi3SetIntervalFraction");
}

SPOOLFLOW_FMI fmi3Status fmi3SetShiftDecimal(fmi3Instance handle, const fmi3ValueReference[], size_t,
                                             const fmi3Float64[]) {
  return not_offered_in_fmi3(handle, "fmi3SetShiftDecimal");
}

SPOOLFLOW_FMI fmi3Status fmi3SetShiftFraction(fmi3Instance handle, const fmi3ValueReference[], size_t,
                                              const fmi3UInt64[], const fmi3UInt64[]) {
  return not_offered_in_fmi3(handle, "fmi3SetShiftFraction");
}

SPOOLFLOW_FMI fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance handle) {
  return not_offered_in_fmi3(handle, "fmi3EvaluateDiscreteStates");
}

SPOOLFLOW_FMI fmi3Status fmi3UpdateDiscreteStates(fmi3Instance handle, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*,
                                                  fmi3Boolean*, fmi3Boolean*, fmi3Float64*) {
  return not_offered_in_fmi3(handle, "fmi3UpdateDiscreteStates");
}

// Model exchange.

SPOOLFLOW_FMI fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance handle) {
  return not_offered_in_fmi3(handle, "fmi3EnterContinuousTimeMode");
}

SPOOLFLOW_FMI fmi3Status fmi3CompletedIntegratorStep(fmi3Instance handle, fmi3Boolean, fmi3Boolean*, fmi3Boolean*) {
  return not_offered_in_fmi3(handle, "fmi3CompletedIntegratorStep");
}

SPOOLFLOW_FMI fmi3Status fmi3SetTime(fmi3Instance handle, fmi3Float64) {
  return not_offered_in_fmi3(handle, "fmi3SetTime");
}

SPOOLFLOW_FMI fmi3Status fmi3SetContinuousStates(fmi3Instance handle, const fmi3Float64[], size_t) {
  return not_offered_in_fmi3(handle, "fmi3SetContinuousStates");
}

SPOOLFLOW_FMI fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance handle, fmi3Float64[], size_t) {
  return not_offered_in_fmi3(handle, "fmi3GetContinuousStateDerivatives");
}

SPOOLFLOW_FMI fmi3Status fmi3GetEventIndicators(fmi3Instance handle, fmi3Float64[], size_t) {
  return not_offered_in_fmi3(handle, "fmi3GetEventIndicators");
}

SPOOLFLOW_FMI fmi3Status fmi3GetContinuousStates(fmi3Instance handle, fmi3Float64[], size_t) {
  return not_offered_in_fmi3(handle, "fmi3GetContinuousStates");
}

SPOOLFLOW_FMI fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance handle, fmi3Float64[], size_t) {
  return not_offered_in_fmi3(handle, "fmi3GetNominalsOfContinuousStates");
}

SPOOLFLOW_FMI fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance handle, size_t*) {
  return not_offered_in_fmi3(handle, "fmi3GetNumberOfEventIndicators");
}

SPOOLFLOW_FMI fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance handle, size_t*) {
  return not_offered_in_fmi3(handle, "fmi3GetNumberOfContinuousStates");
}

// Scheduled execution.

SPOOLFLOW_FMI fmi3Status fmi3ActivateModelPartition(fmi3Instance handle, fmi3ValueReference, fmi3Float64) {
  return not_offered_in_fmi3(handle, "fmi3ActivateModelPartition");
}
