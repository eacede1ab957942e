/// FMI 3.0: reading and writing variables of every type.
#include "spoolflow/export/fmu/exported.hpp"
#include "spoolflow/export/fmu/fmi3_instance.hpp"

namespace fmu = spoolflow::exports::fmu;
using fmu::Instance;
using fmu::on_fmi3;
using std::size_t;

namespace {

void require(size_t references, size_t values) {
  if (references != values)
    throw fmu::CallError("as many values as value references are needed: all variables are scalars");
}

template <class Value>
fmi3Status get(fmi3Instance handle, const fmi3ValueReference* references, size_t count, Value* values,
               size_t value_count, fmu::Type type) {
  return on_fmi3(handle, [&](Instance& instance) {
    require(count, value_count);
    for (size_t k = 0; k < count; ++k) values[k] = static_cast<Value>(instance.get(references[k], type));
  });
}

template <class Value>
fmi3Status set(fmi3Instance handle, const fmi3ValueReference* references, size_t count, const Value* values,
               size_t value_count, fmu::Type type) {
  return on_fmi3(handle, [&](Instance& instance) {
    require(count, value_count);
    instance.set({references, count}, type, [&](size_t k) { return static_cast<double>(values[k]); });
  });
}

/// No variable has this type.
fmi3Status none(fmi3Instance handle, size_t count, const char* type) {
  return on_fmi3(handle, [&](Instance&) {
    if (count > 0) throw fmu::CallError(std::string("this FMU has no variables of type ") + type);
  });
}

}  // namespace

#define SPOOLFLOW_VALUES(NAME, TYPE)                                                                               \
  SPOOLFLOW_FMI fmi3Status fmi3Get##NAME(fmi3Instance handle, const fmi3ValueReference references[], size_t count, \
                                         fmi3##NAME values[], size_t value_count) {                                \
    return get(handle, references, count, values, value_count, fmu::Type::TYPE);                                   \
  }                                                                                                                \
  SPOOLFLOW_FMI fmi3Status fmi3Set##NAME(fmi3Instance handle, const fmi3ValueReference references[], size_t count, \
                                         const fmi3##NAME values[], size_t value_count) {                          \
    return set(handle, references, count, values, value_count, fmu::Type::TYPE);                                   \
  }
SPOOLFLOW_VALUES(Float64, real)
SPOOLFLOW_VALUES(Int32, integer)
SPOOLFLOW_VALUES(Boolean, boolean)

#define SPOOLFLOW_NO_VALUES(NAME)                                                                                     \
  SPOOLFLOW_FMI fmi3Status fmi3Get##NAME(fmi3Instance handle, const fmi3ValueReference[], size_t count, fmi3##NAME[], \
                                         size_t) {                                                                    \
    return none(handle, count, #NAME);                                                                                \
  }                                                                                                                   \
  SPOOLFLOW_FMI fmi3Status fmi3Set##NAME(fmi3Instance handle, const fmi3ValueReference[], size_t count,               \
                                         const fmi3##NAME[], size_t) {                                                \
    return none(handle, count, #NAME);                                                                                \
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
  return none(handle, count, "Binary");
}

SPOOLFLOW_FMI fmi3Status fmi3SetBinary(fmi3Instance handle, const fmi3ValueReference[], size_t count, const size_t[],
                                       const fmi3Binary[], size_t) {
  return none(handle, count, "Binary");
}

SPOOLFLOW_FMI fmi3Status fmi3GetClock(fmi3Instance handle, const fmi3ValueReference[], size_t count, fmi3Clock[]) {
  return none(handle, count, "Clock");
}

SPOOLFLOW_FMI fmi3Status fmi3SetClock(fmi3Instance handle, const fmi3ValueReference[], size_t count,
                                      const fmi3Clock[]) {
  return none(handle, count, "Clock");
}
