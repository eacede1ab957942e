#include "spoolflow/estimation/status_text.hpp"

namespace spoolflow::estimation {

std::string_view StatusText::operator()(sensor::Status status) {
  if (status == sensor::Status::none) return {};
  for (const auto& [bits, text] : known_) {
    if (bits == status) return text;
  }
  std::string text;
  const auto add = [&](const sensor::StatusName& entry) {
    if (!sensor::has(status, entry.bit)) return;
    if (!text.empty()) text += '|';
    text += entry.name;
  };
  for (const sensor::StatusName& entry : sensor::status_names) add(entry);
  add(sensor::monitor_status_name);
  known_.emplace_back(status, std::move(text));
  return known_.back().second;
}

}  // namespace spoolflow::estimation
