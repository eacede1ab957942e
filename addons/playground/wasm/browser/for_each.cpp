// In place of spoolflow/parallel/for_each.cpp: the page's program has one thread.
#include "spoolflow/parallel/for_each.hpp"

namespace spoolflow::parallel {

unsigned cores() {
  return 1;
}

void for_each(std::size_t count, unsigned, const std::function<void(std::size_t)>& work) {
  for (std::size_t k = 0; k < count; ++k) work(k);
}

}  // namespace spoolflow::parallel
