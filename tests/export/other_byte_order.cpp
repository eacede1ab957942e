/// On a machine whose bytes lie the other way round a parameter image is refused by a code of its own, and a sound one
/// is taken elsewhere. other_byte_order IMAGE; 0: so it is.
#include <cstdio>
#include <cstdlib>

#include "spoolflow/sensor/parameter_image/parameters_from.hpp"

namespace {

alignas(8) unsigned char page[1U << 18U];

}  // namespace

int main(int argc, char** argv) {
  std::FILE* const file = argc == 2 ? std::fopen(argv[1], "rb") : nullptr;
  if (file == nullptr) return 2;
  const std::size_t size = std::fread(page, 1, sizeof page, file);
  std::fclose(file);
  namespace sensor = spoolflow::sensor;
  sensor::ValveParameters valve;
  const sensor::ImageRefusal refusal = sensor::parameters_from(page, size, valve);
  const std::uint32_t one = 1;
  const bool lowest_first = *reinterpret_cast<const unsigned char*>(&one) == 1;
  std::printf("%s first: %s\n", lowest_first ? "lowest byte" : "highest byte", text_of(refusal));
  if (lowest_first) return refusal == sensor::ImageRefusal::none && valve.observer_b != nullptr ? 0 : 1;
  return refusal == sensor::ImageRefusal::other_byte_order && valve.header == nullptr && valve.observer_b == nullptr
             ? 0
             : 1;
}
