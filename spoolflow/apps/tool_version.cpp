#include "spoolflow/apps/tool_version.hpp"

namespace spoolflow::apps {

std::string_view tool_version() {
  return SPOOLFLOW_VERSION;
}

}  // namespace spoolflow::apps
