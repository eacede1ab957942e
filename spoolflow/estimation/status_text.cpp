#include "spoolflow/estimation/status_text.hpp"

namespace spoolflow::estimation {

std::string_view StatusText::operator()(sensor::Status status) {
  if (status == sensor::Status::none) return {};
  for (const auto& [bits, text] : known_) {
    if (bits == status) return text;
  }
  std::string text;
  for (const sensor::StatusName& entry : sensor::status_names) {
    if (!sensor::has(status, entry.bit)) continue;
    if (!text.empty()) text += '|';
    text += entry.name;
  }
  known_.emplace_back(status, std::move(text));
  return known_.back().second;
}

}  // namespace spoolflow::estimation
