#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "spoolflow/sensor/basis/status.hpp"

namespace spoolflow::estimation {

/// Names of the set bits, joined by '|'; empty when all is well. Each combination is put together once.
class StatusText {
 public:
  [[nodiscard]] std::string_view operator()(sensor::Status status);

 private:
  std::vector<std::pair<sensor::Status, std::string>> known_;
};

}  // namespace spoolflow::estimation
