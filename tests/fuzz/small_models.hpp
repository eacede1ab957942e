#pragma once
/// The small model of one direction as a file holds it, and a whole valve made of it twice.
#include <fstream>
#include <string>

#include <nlohmann/json.hpp>

namespace spoolflow::fuzz {

struct SmallModels {
  std::string one;
  std::string whole;
};

inline SmallModels small_models() {
  std::ifstream in(SPOOLFLOW_FUZZ_MODEL);
  auto model = nlohmann::ordered_json::parse(in);
  SmallModels out{model.dump(), {}};
  model["valve"]["direction"] = "both";
  model["p_to_a"] = {
      {"condensed", model["condensed"]}, {"observer", model["observer"]}, {"evidence", model["evidence"]}};
  out.whole = model.dump();
  return out;
}

}  // namespace spoolflow::fuzz
