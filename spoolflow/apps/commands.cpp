#include "spoolflow/apps/commands.hpp"

#include <stdexcept>

namespace spoolflow::apps {

void throw_together(const std::vector<std::exception_ptr>& failures) {
  if (failures.size() == 1) std::rethrow_exception(failures.front());
  SeveralFailures all;
  for (const std::exception_ptr& failure : failures) {
    try {
      std::rethrow_exception(failure);
    } catch (const std::exception& error) {
      all.messages.emplace_back(error.what());
      all.of_the_work = all.of_the_work || dynamic_cast<const std::invalid_argument*>(&error) == nullptr;
    }
  }
  throw all;
}

}  // namespace spoolflow::apps
