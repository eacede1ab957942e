/// Model files: a whole model whose values are replaced. Each eleven bytes name a place and what stands there instead.
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/fuzz/model_file.hpp"

namespace {

using Json = nlohmann::ordered_json;

/// Every place of the model, inner ones too.
void list_places(const Json& value, const Json::json_pointer& at, std::vector<Json::json_pointer>& out) {
  if (!at.empty()) out.push_back(at);
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) list_places(member, at / key, out);
  } else if (value.is_array()) {
    for (std::size_t k = 0; k < value.size(); ++k) list_places(value[k], at / k, out);
  }
}

struct Base {
  Json model;
  std::vector<Json::json_pointer> places;
};

Base read_base() {
  std::ifstream in(SPOOLFLOW_FUZZ_MODEL);
  Base base{Json::parse(in), {}};
  list_places(base.model, Json::json_pointer(), base.places);
  // Throws where the reader refuses it: then make it again with tests/fuzz/small_model.py.
  (void)spoolflow::model::parse_model(base.model.dump(), SPOOLFLOW_FUZZ_MODEL);
  return base;
}

Json replacement(std::uint8_t kind, double number) {
  switch (kind % 8) {
    case 0:
      return nullptr;
    case 1:
      return "text";
    case 2:
      return Json::array();
    case 3:
      return Json::object();
    case 4:
      return static_cast<std::int64_t>(kind) * 1000000007;
    default:
      return number;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace spoolflow;
  static const Base base = read_base();
  constexpr std::size_t record = 11;
  Json changed = base.model;
  for (; size >= record; data += record, size -= record) {
    const std::size_t place = data[0] + 256U * data[1];
    double number = 0;
    std::memcpy(&number, data + 3, sizeof number);
    const auto& at = base.places[place % base.places.size()];
    if (changed.contains(at)) changed[at] = replacement(data[2], number);
  }
  fuzz::keep_or_refuse_model(changed.dump());
  return 0;
}
