/// The TOML files: the first byte says as which of them the rest is read.
#include "spoolflow/recording/campaign.hpp"
#include "spoolflow/recording/channel_map.hpp"
#include "spoolflow/recording/proposal.hpp"
#include "spoolflow/rig/bench/scenario.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"
#include "tests/fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace spoolflow;
  static const fuzz::InputFile file("settings.toml");
  if (size == 0) return 0;
  file.write(data + 1, size - 1);
  try {
    switch (data[0]) {
      case 'c':
        (void)recording::read_campaign(file.path());
        break;
      case 'm':
        fuzz::require(!recording::written(recording::read_channel_map(file.path())).empty());
        break;
      case 's':
        (void)rig::read_scenario(file.path());
        break;
      case 'v':
        (void)rig::read_valve_and_campaign(file.path().string());
        break;
      default:
        break;
    }
  } catch (const std::invalid_argument& error) {
    fuzz::require(error.what()[0] != '\0');
  }
  return 0;
}
