/// FMI 3.0: functions that every FMU must have and this one does not offer, because modelDescription.xml says so.
#include "spoolflow/export/fmu/exported.hpp"
#include "spoolflow/export/fmu/fmi3.hpp"
#include "spoolflow/export/fmu/handle.hpp"

using spoolflow::exports::fmu::not_offered;
using std::size_t;

/// Defines a function of the standard that answers that it is not offered; its arguments after the instance follow its
/// name.
#define SPOOLFLOW_NOT_IN_FMI3(function, ...)                                          \
  SPOOLFLOW_FMI fmi3Status function(fmi3Instance handle __VA_OPT__(, ) __VA_ARGS__) { \
    return not_offered<fmi3Status>(handle, #function);                                \
  }

SPOOLFLOW_NOT_IN_FMI3(fmi3EnterStepMode);  // it leads out of event mode
SPOOLFLOW_NOT_IN_FMI3(fmi3EnterEventMode);
SPOOLFLOW_NOT_IN_FMI3(fmi3GetNumberOfVariableDependencies, fmi3ValueReference, size_t*);
SPOOLFLOW_NOT_IN_FMI3(fmi3GetVariableDependencies, fmi3ValueReference, size_t[], fmi3ValueReference[], size_t[],
                      fmi3DependencyKind[], size_t);
SPOOLFLOW_NOT_IN_FMI3(fmi3GetDirectionalDerivative, const fmi3ValueReference[], size_t, const fmi3ValueReference[],
                      size_t, const fmi3Float64[], size_t, fmi3Float64[], size_t);
SPOOLFLOW_NOT_IN_FMI3(fmi3GetAdjointDerivative, const fmi3ValueReference[], size_t, const fmi3ValueReference[], size_t,
                      const fmi3Float64[], size_t, fmi3Float64[], size_t);
SPOOLFLOW_NOT_IN_FMI3(fmi3EnterConfigurationMode);
SPOOLFLOW_NOT_IN_FMI3(fmi3ExitConfigurationMode);
SPOOLFLOW_NOT_IN_FMI3(fmi3GetOutputDerivatives, const fmi3ValueReference[], size_t, const fmi3Int32[], fmi3Float64[],
                      size_t);

// Clocks and events.

SPOOLFLOW_NOT_IN_FMI3(fmi3GetIntervalDecimal, const fmi3ValueReference[], size_t, fmi3Float64[],
                      fmi3IntervalQualifier[]);
SPOOLFLOW_NOT_IN_FMI3(fmi3GetIntervalFraction, const fmi3ValueReference[], size_t, fmi3UInt64[], fmi3UInt64[],
                      fmi3IntervalQualifier[]);
SPOOLFLOW_NOT_IN_FMI3(fmi3GetShiftDecimal, const fmi3ValueReference[], size_t, fmi3Float64[]);
SPOOLFLOW_NOT_IN_FMI3(fmi3GetShiftFraction, const fmi3ValueReference[], size_t, fmi3UInt64[], fmi3UInt64[]);
SPOOLFLOW_NOT_IN_FMI3(fmi3SetIntervalDecimal, const fmi3ValueReference[], size_t, const fmi3Float64[]);
SPOOLFLOW_NOT_IN_FMI3(fmi3SetIntervalFraction, const fmi3ValueReference[], size_t, const fmi3UInt64[],
                      const fmi3UInt64[]);
SPOOLFLOW_NOT_IN_FMI3(fmi3SetShiftDecimal, const fmi3ValueReference[], size_t, const fmi3Float64[]);
SPOOLFLOW_NOT_IN_FMI3(fmi3SetShiftFraction, const fmi3ValueReference[], size_t, const fmi3UInt64[], const fmi3UInt64[]);
SPOOLFLOW_NOT_IN_FMI3(fmi3EvaluateDiscreteStates);
SPOOLFLOW_NOT_IN_FMI3(fmi3UpdateDiscreteStates, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*,
                      fmi3Float64*);

// Model exchange.

SPOOLFLOW_NOT_IN_FMI3(fmi3EnterContinuousTimeMode);
SPOOLFLOW_NOT_IN_FMI3(fmi3CompletedIntegratorStep, fmi3Boolean, fmi3Boolean*, fmi3Boolean*);
SPOOLFLOW_NOT_IN_FMI3(fmi3SetTime, fmi3Float64);
SPOOLFLOW_NOT_IN_FMI3(fmi3SetContinuousStates, const fmi3Float64[], size_t);
SPOOLFLOW_NOT_IN_FMI3(fmi3GetContinuousStateDerivatives, fmi3Float64[], size_t);
SPOOLFLOW_NOT_IN_FMI3(fmi3GetEventIndicators, fmi3Float64[], size_t);
SPOOLFLOW_NOT_IN_FMI3(fmi3GetContinuousStates, fmi3Float64[], size_t);
SPOOLFLOW_NOT_IN_FMI3(fmi3GetNominalsOfContinuousStates, fmi3Float64[], size_t);
SPOOLFLOW_NOT_IN_FMI3(fmi3GetNumberOfEventIndicators, size_t*);
SPOOLFLOW_NOT_IN_FMI3(fmi3GetNumberOfContinuousStates, size_t*);

// Scheduled execution.

SPOOLFLOW_NOT_IN_FMI3(fmi3ActivateModelPartition, fmi3ValueReference, fmi3Float64);
