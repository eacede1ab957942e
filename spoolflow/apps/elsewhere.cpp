#include "spoolflow/apps/elsewhere.hpp"

namespace spoolflow::apps {

Elsewhere& elsewhere() {
  static Elsewhere of_the_program;
  return of_the_program;
}

}  // namespace spoolflow::apps
