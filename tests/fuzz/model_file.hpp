#pragma once
/// What must hold for every text as a model file: it is refused by a ModelError, or can be written and comes back as it
/// was.
#include <sstream>
#include <string>

#include "spoolflow/model/model.hpp"
#include "tests/fuzz/input_file.hpp"

namespace spoolflow::fuzz {

inline void keep_or_refuse_model(const std::string& text) {
  try {
    const model::Model model = model::parse_model(text, "model.json");
    std::ostringstream once, twice;
    model::write_model(once, model);
    model::write_model(twice, model::parse_model(once.str(), "again.json"));
    require(once.str() == twice.str());
  } catch (const model::ModelError& error) {
    require(error.what()[0] != '\0');
  }
}

}  // namespace spoolflow::fuzz
