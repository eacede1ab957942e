#pragma once
/// `PROGRAM MODEL.json VALVE [KEY=NUMBER ...]`: the command line of benches that run a model's observer on a valve of
/// the rig.
#include <charconv>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/model/model.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"

namespace spoolflow::bench {

using Settings = std::map<std::string, double>;

/// `settings` with the numbers of the arguments KEY=NUMBER. Throws std::runtime_error of what is none.
inline Settings with_arguments(Settings settings, int count, char** arguments) {
  for (int k = 0; k < count; ++k) {
    const std::string argument = arguments[k];
    const std::size_t equals = argument.find('=');
    const auto known = settings.find(argument.substr(0, equals));
    if (equals == std::string::npos || known == settings.end())
      throw std::runtime_error(argument + " is no KEY=NUMBER");
    const char* end = argument.data() + argument.size();
    if (std::from_chars(argument.data() + equals + 1, end, known->second).ptr != end)
      throw std::runtime_error(argument + " ends in no number");
  }
  return settings;
}

/// Exit status of `run(model, valve as built, settings)`.
template <class Run>
int on_rig_valve(const char* program, int argc, char** argv, Settings settings, const Run& run) {
  if (argc < 3) {
    fmt::print(stderr, "usage: {} MODEL.json VALVE [KEY=NUMBER ...]\n", program);
    return 2;
  }
  try {
    const model::Model model = model::read_model(argv[1]);
    if (!model.observer) throw std::runtime_error("the model has no observer");
    run(model, rig::as_built(rig::read_valve_and_campaign(argv[2]).valve),
        with_arguments(std::move(settings), argc - 3, argv + 3));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", program, error.what());
    return 1;
  }
  return 0;
}

}  // namespace spoolflow::bench
