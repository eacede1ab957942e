/// The texts of spoolflow.h; its status bits are the core's.
#include <algorithm>
#include <array>
#include <string_view>

#include "spoolflow/export/c_interface/spoolflow.h"
#include "spoolflow/sensor/basis/status.hpp"

namespace {

using spoolflow::sensor::Status;

constexpr bool same(std::uint32_t bit, Status status) {
  return bit == static_cast<std::uint32_t>(status);
}

static_assert(same(SPOOLFLOW_STATUS_CLOSED, Status::closed));
static_assert(same(SPOOLFLOW_STATUS_SPOOL_AT_REST, Status::spool_at_rest));
static_assert(same(SPOOLFLOW_STATUS_OUTSIDE_FORCE_MAP, Status::outside_force_map));
static_assert(same(SPOOLFLOW_STATUS_OUTSIDE_FLOW_FORCE_MAP, Status::outside_flow_force_map));
static_assert(same(SPOOLFLOW_STATUS_OUTSIDE_TEMPERATURE, Status::outside_temperature));
static_assert(same(SPOOLFLOW_STATUS_CURRENT_SATURATED, Status::current_saturated));
static_assert(same(SPOOLFLOW_STATUS_DITHERED, Status::dithered));
static_assert(same(SPOOLFLOW_STATUS_SIGN_UNDETERMINED, Status::sign_undetermined));
static_assert(same(SPOOLFLOW_STATUS_AMBIGUOUS_LOAD, Status::ambiguous_load));
static_assert(same(SPOOLFLOW_STATUS_FLOW_REVERSED, Status::flow_reversed));
static_assert(same(SPOOLFLOW_STATUS_OPEN_STOP, Status::open_stop));
static_assert(same(SPOOLFLOW_STATUS_OTHER_DIRECTION, Status::other_direction));
static_assert(same(SPOOLFLOW_STATUS_POSITION_FAULT, Status::position_fault));
static_assert(same(SPOOLFLOW_STATUS_SAMPLE_MISSING, Status::sample_missing));
static_assert(same(SPOOLFLOW_STATUS_TIME_FAULT, Status::time_fault));
static_assert(same(SPOOLFLOW_STATUS_COIL_FAULT, Status::coil_fault));
static_assert(same(SPOOLFLOW_STATUS_TEMPERATURE_FAULT, Status::temperature_fault));
static_assert(same(SPOOLFLOW_STATUS_CURRENT_FAULT, Status::current_fault));
#define SPOOLFLOW_TEXT_OF(NUMBER) #NUMBER
#define SPOOLFLOW_TEXT(NUMBER) SPOOLFLOW_TEXT_OF(NUMBER)
static_assert(std::string_view(SPOOLFLOW_VERSION) == SPOOLFLOW_BUILT_VERSION, "spoolflow.h names another version");
static_assert(std::string_view(SPOOLFLOW_VERSION) ==
              SPOOLFLOW_TEXT(SPOOLFLOW_VERSION_MAJOR) "." SPOOLFLOW_TEXT(SPOOLFLOW_VERSION_MINOR) "." SPOOLFLOW_TEXT(
                  SPOOLFLOW_VERSION_PATCH));
static_assert(SPOOLFLOW_STATUS_FAULTS == spoolflow::sensor::fault_bits);
static_assert(spoolflow::sensor::status_names.size() == 18, "a new status bit belongs into spoolflow.h, too");

}  // namespace

const char* spoolflow_version(void) {
  return SPOOLFLOW_VERSION;
}

const char* spoolflow_status_name(uint32_t bit) {
  for (const spoolflow::sensor::StatusName& entry : spoolflow::sensor::status_names) {
    if (static_cast<std::uint32_t>(entry.bit) == bit) return entry.name;
  }
  return nullptr;
}

size_t spoolflow_status_text(uint32_t status, char* text, size_t size) {
  const std::size_t room = text == nullptr || size == 0 ? 0 : size - 1;
  std::size_t length = 0;
  const auto append = [&](std::string_view part) {
    for (const char letter : part) {
      if (length < room) text[length] = letter;
      ++length;
    }
  };
  for (const spoolflow::sensor::StatusName& entry : spoolflow::sensor::status_names) {
    if ((static_cast<std::uint32_t>(entry.bit) & status) == 0) continue;
    if (length > 0) append("|");
    append(entry.name);
  }
  if (text != nullptr && size > 0) text[std::min(length, room)] = '\0';
  return length;
}

const char* spoolflow_result_text(spoolflow_result result) {
  static constexpr std::array texts{"ok",        "bad argument",     "bad file",      "bad model", "not calibrated",
                                    "bad state", "buffer too small", "out of memory", "failed"};
  const auto place = static_cast<std::size_t>(result);
  return place < texts.size() ? texts[place] : "unknown result";
}
