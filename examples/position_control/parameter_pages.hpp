#pragma once
/// Two flash pages with the valve's parameters. One is at work; both are looked at in slices, in turn and without end:
/// so a newer image is found, and a bit that has fallen. docs/embedded.md walks through it.
#include "spoolflow/sensor/parameter_image/parameters_from.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve_parameters.hpp"

namespace sensor = spoolflow::sensor;

class ParameterPages {
 public:
  static constexpr std::uint32_t words_a_sample = 32;

  ParameterPages(const void* first, const void* second, std::size_t page_bytes)
      : page_{first, second}, page_bytes_(page_bytes) {}

  /// At start-up: all of both pages, and the newer of those that are accepted to work.
  void start() {
    for (std::uint32_t k = 0; k < 2; ++k) {
      sensor::ValveParameters found;
      if (parameters_from(page_[k], page_bytes_, found) == sensor::ImageRefusal::none) take_if_newer(k, found);
    }
    begin_look(0);
  }

  /// One slice, between two samples. True where another page is at work from now on, or none.
  bool look() {
    const bool finished = !begun_ || advance(check_, words_a_sample);
    if (!finished) return false;
    sensor::ValveParameters found;
    const bool accepted = begun_ && parameters_of(check_, found) == sensor::ImageRefusal::none;
    bool changed = false;
    if (accepted) {
      changed = take_if_newer(looked_at_, found);
    } else if (at_work_ == looked_at_ + 1) {  // a bit has fallen: the other page, once it is found whole
      at_work_ = 0;
      valve_ = {};
      changed = true;
    }
    begin_look(1 - looked_at_);
    return changed;
  }

  /// Null where no page is at work.
  [[nodiscard]] const sensor::WholeValveParameters<float>* valve() const { return at_work_ != 0 ? &valve_ : nullptr; }
  [[nodiscard]] std::uint32_t at_work() const { return at_work_; }  ///< 1 or 2; 0: none

 private:
  void begin_look(std::uint32_t page) {
    looked_at_ = page;
    begun_ = begin(check_, page_[page], page_bytes_) == sensor::ImageRefusal::none;
  }
  /// Two words that the step reads: to be called where it is not running.
  bool take_if_newer(std::uint32_t page, const sensor::ValveParameters& found) {
    if (!found.whole() || found.observer_b == nullptr) return false;
    if (at_work_ == page + 1 || (at_work_ != 0 && found.header->created_s <= created_s_)) return false;
    valve_ = {found.observer_b, found.observer_a};
    created_s_ = found.header->created_s;
    at_work_ = page + 1;
    return true;
  }

  const void* page_[2];
  std::size_t page_bytes_;
  sensor::WholeValveParameters<float> valve_{};
  std::uint64_t created_s_ = 0;
  std::uint32_t at_work_ = 0;
  sensor::ImageCheck check_{};
  std::uint32_t looked_at_ = 0;
  bool begun_ = false;
};
