/// The C interface: any of its functions in any order, with any numbers, buffers of exactly the stated size, and
/// states whose bytes were changed, with a checksum that holds. Whatever comes, an answer is finite and inside its
/// band.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "spoolflow/export/c_interface/spoolflow.h"
#include "tests/fuzz/forged_state.hpp"
#include "tests/fuzz/input_file.hpp"
#include "tests/fuzz/odd_number.hpp"
#include "tests/fuzz/small_models.hpp"

namespace {

using namespace spoolflow;
using Bytes = std::vector<char>;

/// Sensors of every kind, to be copied: reading a model takes longer than all the calls.
struct Originals {
  std::array<spoolflow_sensor*, 4> made{};

  Originals() {
    const fuzz::SmallModels models = fuzz::small_models();
    std::size_t next = 0;
    for (const std::string& text : {models.one, models.whole})
      for (const spoolflow_estimator estimator : {SPOOLFLOW_CONDENSED, SPOOLFLOW_OBSERVER}) {
        spoolflow_sensor** out = &made[next++];
        fuzz::require(spoolflow_create_from_memory(text.data(), text.size(), estimator, out, nullptr, 0) ==
                      SPOOLFLOW_OK);
      }
  }
};

void hold(const spoolflow_estimate& answer) {
  for (const double number :
       {answer.flow_m3_per_s, answer.flow_lower_m3_per_s, answer.flow_upper_m3_per_s, answer.pressure_difference_Pa,
        answer.magnetic_force_N, answer.spring_force_N, answer.flow_force_N, answer.friction_force_N})
    fuzz::require(std::isfinite(number));
  fuzz::require(answer.flow_lower_m3_per_s <= answer.flow_m3_per_s &&
                answer.flow_m3_per_s <= answer.flow_upper_m3_per_s);
}

class Calls {
 public:
  explicit Calls(fuzz::Input in) : in_(in) {}
  ~Calls() {
    for (spoolflow_sensor* sensor : sensors_) spoolflow_destroy(sensor);
  }
  Calls(const Calls&) = delete;
  Calls& operator=(const Calls&) = delete;

  void make_all() {
    while (!in_.empty()) make();
  }

 private:
  void make() {
    spoolflow_sensor*& at = sensors_[in_.below(sensors_.size())];
    switch (in_.byte() % 10) {
      case 0:
        return renew(at);
      case 1:
        return destroy(at);
      case 2:
        return refuse_texts();
      case 3:
        return keep_state(at);
      case 4:
        return take_state(at);
      case 5:
        return ask(at);
      case 6:
        return step_columns(at);
      case 7:
        return step_whole(at);
      default:
        return step(at);
    }
  }
  void renew(spoolflow_sensor*& at) {
    static const Originals originals;
    spoolflow_destroy(at);
    at = nullptr;
    const std::size_t from = in_.below(originals.made.size() + sensors_.size());
    const spoolflow_sensor* original =
        from < originals.made.size() ? originals.made[from] : sensors_[from - originals.made.size()];
    const spoolflow_result result = spoolflow_copy(original, &at);
    fuzz::require(original == nullptr ? result == SPOOLFLOW_BAD_ARGUMENT : result == SPOOLFLOW_OK);
  }
  static void destroy(spoolflow_sensor*& at) {
    spoolflow_destroy(at);
    at = nullptr;
  }
  void refuse_texts() {
    spoolflow_sensor* none = nullptr;
    std::vector<char> message(in_.below(40));
    const std::string text(in_.below(20), static_cast<char>(in_.byte()));
    const auto estimator = static_cast<spoolflow_estimator>(in_.byte() % 4);
    fuzz::require(spoolflow_create_from_memory(text.data(), text.size(), estimator, &none, message.data(),
                                               message.size()) != SPOOLFLOW_OK);
    fuzz::require(none == nullptr && (message.empty() || message.back() == '\0' || message.size() > 1));
    fuzz::require(spoolflow_create("/nonexistent/model.json", estimator, &none, message.data(), message.size()) !=
                  SPOOLFLOW_OK);
    (void)spoolflow_status_text(in_.byte() * 0x01010101U, message.data(), message.size());
    (void)spoolflow_status_name(1U << (in_.byte() % 32U));
    (void)spoolflow_result_text(static_cast<spoolflow_result>(in_.byte() % 16));
  }
  void keep_state(spoolflow_sensor* at) {
    const std::size_t size = spoolflow_state_size(at);
    Bytes bytes(in_.byte() % 4 == 0 ? in_.below(size + 1) : size);
    const spoolflow_result result = spoolflow_get_state(at, bytes.data(), bytes.size());
    if (result == SPOOLFLOW_OK) state_ = bytes;
    fuzz::require(result == SPOOLFLOW_OK || at == nullptr || bytes.size() < size);
  }
  void take_state(spoolflow_sensor* at) {
    Bytes bytes = state_;
    const bool forged = fuzz::forge_state(in_, bytes);
    char message[64];
    const spoolflow_result result = spoolflow_set_state(at, bytes.data(), bytes.size(), message, sizeof message);
    fuzz::require(result == SPOOLFLOW_OK || message[0] != '\0');
    if (result != SPOOLFLOW_OK) return;
    forged_ = forged_ || forged;
    Bytes again(spoolflow_state_size(at));
    fuzz::require(spoolflow_get_state(at, again.data(), again.size()) == SPOOLFLOW_OK);
  }
  void ask(spoolflow_sensor* at) {
    if (in_.byte() % 4 == 0) (void)spoolflow_reset(at);
    if (at == nullptr) return;
    fuzz::require(spoolflow_runs(at) != SPOOLFLOW_BEST && spoolflow_valve_name(at)[0] != '\0' &&
                  spoolflow_rated_flow(at) > 0);
    (void)spoolflow_is_whole(at);
  }
  double next_time_s() {
    time_s_ += in_.number(1e-3, 1e-3);
    if (!std::isfinite(time_s_)) time_s_ = 0;
    return in_.byte() % 32 == 0 ? in_.number(time_s_, 1) : time_s_;
  }
  spoolflow_sample next_sample() {
    const double time_s = next_time_s();
    const double current_A = in_.number(1, 2), voltage_V = in_.number(8, 20), position_m = in_.number(0.5e-3, 2e-3);
    return {time_s, current_A, voltage_V, position_m, in_.number(313, 60)};
  }
  void step(spoolflow_sensor* at) {
    const spoolflow_sample sample = next_sample();
    spoolflow_estimate answer{};
    if (spoolflow_step(at, &sample, &answer) != SPOOLFLOW_OK) return fuzz::require(at == nullptr);
    if (forged_) return;
    hold(answer);
    if (!std::isfinite(sample.time_s)) fuzz::require((answer.status & SPOOLFLOW_STATUS_TIME_FAULT) != 0);
    if (std::isnan(sample.current_A) || std::isnan(sample.position_m))
      fuzz::require((answer.status & SPOOLFLOW_STATUS_SAMPLE_MISSING) != 0);
  }
  void step_whole(spoolflow_sensor* at) {
    const spoolflow_sample b = next_sample();
    const double current_a_A = in_.number(0, 2);
    const spoolflow_whole_sample sample{b.time_s,    current_a_A,  b.current_A,        in_.number(8, 20),
                                        b.voltage_V, b.position_m, b.oil_temperature_K};
    const spoolflow_port_pressures ports{in_.number(60e5, 40e5), in_.number(30e5, 40e5), in_.number(30e5, 40e5),
                                         in_.number(1e5, 40e5)};
    spoolflow_estimate answer{};
    const spoolflow_result result =
        spoolflow_step_whole_ports(at, &sample, in_.byte() % 2 == 0 ? nullptr : &ports, &answer);
    if (result != SPOOLFLOW_OK) return fuzz::require(at == nullptr || spoolflow_is_whole(at) == 0);
    if (!forged_) hold(answer);
  }
  void step_columns(spoolflow_sensor* at) {
    const std::size_t count = in_.below(5);
    std::array<std::vector<double>, 5> given;
    std::array<std::vector<double>, 8> answers;
    for (auto& column : answers) column.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const spoolflow_sample one = next_sample();
      given[0].push_back(one.time_s), given[1].push_back(one.current_A), given[2].push_back(one.voltage_V);
      given[3].push_back(one.position_m), given[4].push_back(one.oil_temperature_K);
    }
    const std::uint8_t absent = in_.byte();
    const auto in = [&](std::size_t k) { return (absent >> k) % 4 == 3 ? nullptr : given[k].data(); };
    const auto out = [&](std::size_t k) { return (absent >> (k % 4)) % 4 == 2 ? nullptr : answers[k].data(); };
    const spoolflow_inputs inputs{in(0), in(1), in(2), in(3), in(4)};
    const spoolflow_outputs outputs{out(0), out(1), out(2), out(3), out(4), out(5), out(6), out(7), nullptr};
    (void)spoolflow_step_arrays(at, count, &inputs, &outputs);
    if (forged_) return;
    for (const auto& column : answers)
      for (const double number : column) fuzz::require(std::isfinite(number));
  }

  fuzz::Input in_;
  std::array<spoolflow_sensor*, 3> sensors_{};
  Bytes state_;
  bool forged_ = false;  ///< a changed state was taken
  double time_s_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Calls calls(spoolflow::fuzz::Input(data, size));
  calls.make_all();
  return 0;
}
