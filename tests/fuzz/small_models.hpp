#pragma once
/// The small model of one direction as a file holds it, and a whole valve made of it twice: joined as texts, because
/// JSON takes long to compile.
#include <fstream>
#include <iterator>
#include <string>

#include "tests/fuzz/input_file.hpp"

namespace spoolflow::fuzz {

struct SmallModels {
  std::string one;
  std::string whole;
};

inline SmallModels small_models() {
  std::ifstream in(SPOOLFLOW_FUZZ_MODEL);
  const std::string one{std::istreambuf_iterator<char>(in), {}};
  // The second direction is everything from the condensed sensor on, once more.
  const std::string direction = "\"direction\":\"b\"";
  const std::size_t at = one.find(direction), sensors = one.find("\"condensed\":"), end = one.rfind('}');
  require(at < sensors && sensors < end && end < one.size());
  std::string whole = one.substr(0, end) + ",\"p_to_a\":{" + one.substr(sensors, end - sensors) + "}}";
  whole.replace(at, direction.size(), "\"direction\":\"both\"");
  return {one, whole};
}

}  // namespace spoolflow::fuzz
