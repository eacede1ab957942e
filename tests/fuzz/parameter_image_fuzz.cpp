/// Images of parameters: sound ones of which words are changed, sealed again or not, cut, or any bytes at all. Whatever
/// they are, the check comes to an end and reads nothing beyond the page; what it takes lies inside the image, and the
/// sensors step on it.
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "spoolflow/export/parameters/image_summary.hpp"
#include "spoolflow/export/parameters/parameter_image.hpp"
#include "spoolflow/numerics/crc32.hpp"
#include "spoolflow/sensor/observer.hpp"
#include "spoolflow/sensor/parameter_image/parameters_from.hpp"
#include "spoolflow/sensor/whole_valve/whole_condensed.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve.hpp"
#include "tests/fuzz/odd_number.hpp"
#include "tests/fuzz/small_models.hpp"

namespace {

using namespace spoolflow;
using sensor::ImageHeader;

struct Images {
  std::string one;
  std::string whole;
};

const Images& images() {
  static const Images made = [] {
    const fuzz::SmallModels models = fuzz::small_models();
    const exports::ImageContents contents{"fuzz", 1700000000U};
    return Images{exports::parameter_image(model::parse_model(models.one, "one"), contents),
                  exports::parameter_image(model::parse_model(models.whole, "whole"), contents)};
  }();
  return made;
}

/// Exactly the page's bytes at an aligned address, so that a read beyond them is found.
class Page {
 public:
  explicit Page(const std::string& bytes) : size_(bytes.size()), bytes_(new (std::align_val_t{8}) char[size_]) {
    std::memcpy(bytes_, bytes.data(), size_);
  }
  ~Page() { ::operator delete[](bytes_, std::align_val_t{8}); }
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;
  [[nodiscard]] const char* begin() const { return bytes_; }
  [[nodiscard]] const char* end() const { return bytes_ + size_; }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  std::size_t size_;
  char* bytes_;
};

/// The sum that the bytes have come to need, as far as they go.
void seal(std::string& bytes) {
  std::uint32_t total = 0;
  std::memcpy(&total, bytes.data() + offsetof(ImageHeader, total_bytes), sizeof total);
  std::string summed = bytes.substr(0, total);
  if (summed.size() < sizeof(ImageHeader)) return;
  summed.erase(offsetof(ImageHeader, crc32), sizeof(std::uint32_t));
  const std::uint32_t sum = numerics::crc32({reinterpret_cast<const std::uint8_t*>(summed.data()), summed.size()});
  std::memcpy(bytes.data() + offsetof(ImageHeader, crc32), &sum, sizeof sum);
}

/// A word somewhere: in the header half of the time, a float or any bits.
void change(std::string& bytes, fuzz::Input& in) {
  const std::size_t words = (in.byte() % 2 == 0 ? sizeof(ImageHeader) : bytes.size()) / sizeof(std::uint32_t);
  const std::size_t place = (in.byte() + 256U * in.byte() + 65536U * in.byte()) % words * sizeof(std::uint32_t);
  if (in.byte() % 2 == 0) {
    float before = 0;
    std::memcpy(&before, bytes.data() + place, sizeof before);
    const auto after = static_cast<float>(in.number(before, 1.0));
    std::memcpy(bytes.data() + place, &after, sizeof after);
  } else {
    for (std::size_t k = 0; k < sizeof(std::uint32_t); ++k) bytes[place + k] = static_cast<char>(in.byte());
  }
}

std::string page_bytes(fuzz::Input& in) {
  const std::uint8_t kind = in.byte();
  std::string bytes = kind % 2 == 0 ? images().one : images().whole;
  if (kind % 16 == 15) {  // any bytes behind the magic ones
    bytes.resize(8);
    while (!in.empty()) bytes += static_cast<char>(in.byte());
    return bytes;
  }
  const int changes = in.byte() % 8;
  for (int k = 0; k < changes; ++k) change(bytes, in);
  if ((kind & 2U) == 0) seal(bytes);
  if ((kind & 12U) == 12U) bytes.resize((in.byte() + 256U * in.byte()) % bytes.size());
  return bytes;
}

template <class Tables>
bool lies_in(const Page& page, const Tables* tables) {
  const char* const first = reinterpret_cast<const char*>(tables);
  return tables == nullptr || (first >= page.begin() + sizeof(ImageHeader) && first + sizeof(Tables) <= page.end());
}

sensor::WholeValveSample<float> sample_of(fuzz::Input& in) {
  const auto number = [&in](double usual, double spread) { return static_cast<float>(in.number(usual, spread)); };
  return {number(1e-3, 1e-3), number(0.2, 2),       number(1, 2),    number(8, 20),
          number(8, 20),      number(0.5e-3, 2e-3), number(313, 60), {}};
}

void step_all(const sensor::ValveParameters& valve, fuzz::Input& in) {
  sensor::ObserverState<float> observer{};
  sensor::CondensedState<float> condensed{};
  sensor::WholeValveState<float> both{};
  sensor::WholeCondensedState<float> both_condensed{};
  const sensor::WholeValveParameters<float> sides{valve.observer_b, valve.observer_a};
  const sensor::WholeCondensedTables<float> condensed_sides{valve.condensed_b, valve.condensed_a};
  for (int k = 0; k < 40; ++k) {
    const sensor::WholeValveSample<float> sample = sample_of(in);
    const sensor::Sample<float> one = sensor::sample_of(sample, false);
    if (valve.observer_b != nullptr) step(*valve.observer_b, observer, one);
    if (valve.condensed_b != nullptr) step(*valve.condensed_b, condensed, one);
    if (valve.observer_a != nullptr) step(sides, both, sample);
    if (valve.condensed_a != nullptr) step(condensed_sides, both_condensed, sample);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input in(data, size);
  const std::string bytes = page_bytes(in);
  const Page page(bytes);
  sensor::ValveParameters valve;
  const sensor::ImageRefusal refusal = parameters_from(page.begin(), page.size(), valve);
  if (size % 8 == 1) fuzz::require(exports::image_summary(bytes).refusal == refusal);
  fuzz::require((refusal == sensor::ImageRefusal::none) == (valve.header != nullptr));
  if (valve.header == nullptr) return 0;
  fuzz::require(lies_in(page, valve.observer_b) && lies_in(page, valve.observer_a) &&
                lies_in(page, valve.condensed_b) && lies_in(page, valve.condensed_a));
  fuzz::require(valve.observer_b != nullptr || valve.condensed_b != nullptr);
  step_all(valve, in);
  return 0;
}
