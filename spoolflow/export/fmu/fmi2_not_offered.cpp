/// FMI 2.0: functions that every FMU must have and this one does not offer, because modelDescription.xml says so.
#include "spoolflow/export/fmu/exported.hpp"
#include "spoolflow/export/fmu/fmi2.hpp"
#include "spoolflow/export/fmu/handle.hpp"

using spoolflow::exports::fmu::not_offered;
using std::size_t;

/// Defines a function of the standard that answers that it is not offered; its arguments after the instance follow its
/// name.
#define SPOOLFLOW_NOT_IN_FMI2(function, ...)                                              \
  SPOOLFLOW_FMI fmi2Status function(fmi2Component component __VA_OPT__(, ) __VA_ARGS__) { \
    return not_offered<fmi2Status>(component, #function);                                 \
  }

SPOOLFLOW_NOT_IN_FMI2(fmi2GetDirectionalDerivative, const fmi2ValueReference[], size_t, const fmi2ValueReference[],
                      size_t, const fmi2Real[], fmi2Real[]);
SPOOLFLOW_NOT_IN_FMI2(fmi2SetRealInputDerivatives, const fmi2ValueReference[], size_t, const fmi2Integer[],
                      const fmi2Real[]);
SPOOLFLOW_NOT_IN_FMI2(fmi2GetRealOutputDerivatives, const fmi2ValueReference[], size_t, const fmi2Integer[],
                      fmi2Real[]);
SPOOLFLOW_NOT_IN_FMI2(fmi2CancelStep);

// Model exchange.

SPOOLFLOW_NOT_IN_FMI2(fmi2EnterEventMode);
SPOOLFLOW_NOT_IN_FMI2(fmi2NewDiscreteStates, fmi2EventInfo*);
SPOOLFLOW_NOT_IN_FMI2(fmi2EnterContinuousTimeMode);
SPOOLFLOW_NOT_IN_FMI2(fmi2CompletedIntegratorStep, fmi2Boolean, fmi2Boolean*, fmi2Boolean*);
SPOOLFLOW_NOT_IN_FMI2(fmi2SetTime, fmi2Real);
SPOOLFLOW_NOT_IN_FMI2(fmi2SetContinuousStates, const fmi2Real[], size_t);
SPOOLFLOW_NOT_IN_FMI2(fmi2GetDerivatives, fmi2Real[], size_t);
SPOOLFLOW_NOT_IN_FMI2(fmi2GetEventIndicators, fmi2Real[], size_t);
SPOOLFLOW_NOT_IN_FMI2(fmi2GetContinuousStates, fmi2Real[], size_t);
SPOOLFLOW_NOT_IN_FMI2(fmi2GetNominalsOfContinuousStates, fmi2Real[], size_t);
