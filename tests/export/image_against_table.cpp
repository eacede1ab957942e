// Compiled by a test into an exported folder: every answer of the sensors is the same bit for bit whether their numbers
// come from the exported header or from the image valve.bin, over the samples of run.bin (five floats each). Status 0:
// all are; 1: an answer differs; 2: the image is refused or is of another valve.
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "spoolflow/sensor/parameter_image/parameters_from.hpp"
#include "valve_model.hpp"

namespace sensor = spoolflow::sensor;

namespace {

template <class T>
std::vector<T> numbers_of(const char* name) {
  std::FILE* const file = std::fopen(name, "rb");
  std::vector<T> out;
  for (T number; file != nullptr && std::fread(&number, sizeof number, 1, file) == 1;) out.push_back(number);
  if (file != nullptr) std::fclose(file);
  return out;
}

/// One direction's samples as they are, and to a whole valve with the sides exchanged every second.
sensor::Sample<float> sample_of(const float* in, std::size_t /*k*/, sensor::Sample<float>) {
  return {in[0], in[1], in[2], in[3], in[4]};
}
sensor::WholeValveSample<float> sample_of(const float* in, std::size_t k, sensor::WholeValveSample<float>) {
  if (k / 1000 % 2 == 0) return {in[0], 0.0F, in[1], 0.0F, in[2], in[3], in[4], {}};
  return {in[0], in[1], 0.0F, in[2], 0.0F, -in[3], in[4], {}};
}

template <class State, class Sample, class Exported, class Read>
bool agree(const Exported& exported, const Read& read, const std::vector<float>& run) {
  const auto state = std::make_unique<State>(), other = std::make_unique<State>();
  for (std::size_t k = 0; 5 * k + 5 <= run.size(); ++k) {
    const Sample sample = sample_of(&run[5 * k], k, Sample{});
    const sensor::Estimate<float>& one = step(exported, *state, sample);
    const sensor::Estimate<float>& two = step(read, *other, sample);
    if (std::memcmp(&one, &two, sizeof one) != 0) return false;
  }
  return run.size() > 50000;
}

}  // namespace

int main() {
  const std::vector<float> run = numbers_of<float>("run.bin");
  const std::vector<std::uint64_t> image = numbers_of<std::uint64_t>("valve.bin");
  sensor::ValveParameters valve;
  if (parameters_from(image.data(), image.size() * sizeof(std::uint64_t), valve) != sensor::ImageRefusal::none)
    return 2;
  if (std::strcmp(valve.header->valve_name, valve_model::name) != 0 || !valve.whole()) return 2;
  const sensor::WholeValveParameters<float> observer{valve.observer_b, valve.observer_a};
  const sensor::WholeCondensedTables<float> condensed{valve.condensed_b, valve.condensed_a};
  using sensor::Sample;
  const bool same =
      agree<valve_model::State, valve_model::Sample>(valve_model::observer, observer, run) &&
      agree<valve_model::CondensedState, valve_model::Sample>(valve_model::condensed, condensed, run) &&
      agree<sensor::ObserverState<float>, Sample<float>>(valve_model::observer_b, *valve.observer_b, run) &&
      agree<sensor::CondensedState<float>, Sample<float>>(valve_model::condensed_a, *valve.condensed_a, run);
  return same ? 0 : 1;
}
