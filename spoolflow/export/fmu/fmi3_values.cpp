/// FMI 3.0: reading and writing variables of every type.
#include "spoolflow/export/fmu/exported.hpp"
#include "spoolflow/export/fmu/fmi3.hpp"
#include "spoolflow/export/fmu/handle.hpp"

namespace fmu = spoolflow::exports::fmu;
using std::size_t;

#define SPOOLFLOW_VALUES(NAME, TYPE)                                                                               \
  SPOOLFLOW_FMI fmi3Status fmi3Get##NAME(fmi3Instance handle, const fmi3ValueReference references[], size_t count, \
                                         fmi3##NAME values[], size_t value_count) {                                \
    return fmu::get<fmi3Status, fmi3##NAME>(handle, {references, count}, {values, value_count}, fmu::Type::TYPE);  \
  }                                                                                                                \
  SPOOLFLOW_FMI fmi3Status fmi3Set##NAME(fmi3Instance handle, const fmi3ValueReference references[], size_t count, \
                                         const fmi3##NAME values[], size_t value_count) {                          \
    return fmu::set<fmi3Status, fmi3##NAME>(handle, {references, count}, {values, value_count}, fmu::Type::TYPE);  \
  }
SPOOLFLOW_VALUES(Float64, real)
SPOOLFLOW_VALUES(Int32, integer)
SPOOLFLOW_VALUES(Boolean, boolean)

#define SPOOLFLOW_NO_VALUES(NAME)                                                                                     \
  SPOOLFLOW_FMI fmi3Status fmi3Get##NAME(fmi3Instance handle, const fmi3ValueReference[], size_t count, fmi3##NAME[], \
                                         size_t) {                                                                    \
    return fmu::no_values<fmi3Status>(handle, count, #NAME);                                                          \
  }                                                                                                                   \
  SPOOLFLOW_FMI fmi3Status fmi3Set##NAME(fmi3Instance handle, const fmi3ValueReference[], size_t count,               \
                                         const fmi3##NAME[], size_t) {                                                \
    return fmu::no_values<fmi3Status>(handle, count, #NAME);                                                          \
  }
SPOOLFLOW_NO_VALUES(Float32)
SPOOLFLOW_NO_VALUES(Int8)
SPOOLFLOW_NO_VALUES(UInt8)
SPOOLFLOW_NO_VALUES(Int16)
SPOOLFLOW_NO_VALUES(UInt16)
SPOOLFLOW_NO_VALUES(UInt32)
SPOOLFLOW_NO_VALUES(Int64)
SPOOLFLOW_NO_VALUES(UInt64)
SPOOLFLOW_NO_VALUES(String)

SPOOLFLOW_FMI fmi3Status fmi3GetBinary(fmi3Instance handle, const fmi3ValueReference[], size_t count, size_t[],
                                       fmi3Binary[], size_t) {
  return fmu::no_values<fmi3Status>(handle, count, "Binary");
}

SPOOLFLOW_FMI fmi3Status fmi3SetBinary(fmi3Instance handle, const fmi3ValueReference[], size_t count, const size_t[],
                                       const fmi3Binary[], size_t) {
  return fmu::no_values<fmi3Status>(handle, count, "Binary");
}

SPOOLFLOW_FMI fmi3Status fmi3GetClock(fmi3Instance handle, const fmi3ValueReference[], size_t count, fmi3Clock[]) {
  return fmu::no_values<fmi3Status>(handle, count, "Clock");
}

SPOOLFLOW_FMI fmi3Status fmi3SetClock(fmi3Instance handle, const fmi3ValueReference[], size_t count,
                                      const fmi3Clock[]) {
  return fmu::no_values<fmi3Status>(handle, count, "Clock");
}
