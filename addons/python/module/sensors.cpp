#include <algorithm>
#include <array>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <stdexcept>

#include <fmt/format.h>

#include "addons/python/module/bindings.hpp"
#include "addons/python/module/columns.hpp"
#include "addons/python/module/models.hpp"
#include "addons/python/module/signal_check.hpp"
#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/estimation/status_text.hpp"
#include "spoolflow/model/json_text.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::python {
namespace {

namespace py = pybind11;

/// A sensor in operation, for one thread at a time.
class WorkingSensor {
 public:
  WorkingSensor(SharedModel model, const std::string& estimator)
      : model_(std::move(model)), sensor_(estimation::running_sensor(model_->model, estimator_named(estimator))) {}

  /// One sample, its numbers in the order of column_names. Goes the library's way: a step compiled here, with less
  /// optimisation, would take the place of the library's for all of the module.
  sensor::Estimate<double> step(const std::array<double, column_names.size()>& numbers) {
    const Turn turn(busy_);
    estimation::Columns columns{};
    for (std::size_t k = 0; k < numbers.size(); ++k) columns.*(column_names[k].column) = {&numbers[k], 1};
    sensor::Estimate<double> out;
    estimation::run(sensor_, columns, std::span(&out, 1));
    return out;
  }

  /// The arrays of one estimate a sample; goes on where the sensor was.
  py::dict run(const py::dict& arrays) {
    const Turn turn(busy_);
    const ColumnArrays given(arrays);
    const estimation::Columns& columns = given.columns();
    EstimateArrays out(columns.size());
    at_work([&](SignalCheck& check) { answer_run(sensor_, columns, out, check); });
    return out.by_name();
  }

  /// Of the last sample that had a time [s]; NaN before.
  [[nodiscard]] double time_s() const {
    const estimation::SampleTimes& times = sensor_.state().times;
    return times.started ? times.last_time_s : estimation::not_measured;
  }

  void reset() {
    const Turn turn(busy_);
    sensor_.reset();
  }

 private:
  /// Throws where another thread is at it.
  class Turn {
   public:
    explicit Turn(std::atomic_flag& busy) : busy_(busy) {
      if (busy_.test_and_set())
        throw std::invalid_argument("the sensor is at work in another thread; give each thread a sensor of its own");
    }
    ~Turn() { busy_.clear(); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    std::atomic_flag& busy_;
  };

  SharedModel model_;
  estimation::RunningSensor sensor_;
  std::atomic_flag busy_ = ATOMIC_FLAG_INIT;
};

SharedModel read_model(const std::filesystem::path& file) {
  std::error_code unreadable;
  std::ifstream in(file, std::ios::binary);
  const std::string text =
      std::filesystem::is_directory(file, unreadable) || !in ? std::string() : model::read_json_text(in);
  if (text.empty()) (void)model::read_model(file);  // which reports why there is none
  return std::make_shared<KeptModel>(text, file.string());
}

std::vector<std::string> estimators(const KeptModel& kept) {
  std::vector<std::string> out;
  for (const estimation::Estimator each : estimation::all_estimators(kept.model)) out.emplace_back(name(each));
  return out;
}

py::list status_bits() {
  py::list out;
  for (const sensor::StatusName& each : sensor::status_names)
    out.append(py::make_tuple(each.name, static_cast<std::uint32_t>(each.bit)));
  out.append(
      py::make_tuple(sensor::monitor_status_name.name, static_cast<std::uint32_t>(sensor::monitor_status_name.bit)));
  return out;
}

void add_model(py::module_& module) {
  py::class_<KeptModel, std::shared_ptr<KeptModel>>(module, "Model")
      .def(py::init<std::string, std::string>())
      .def_property_readonly("text", [](const KeptModel& self) { return self.text; })
      .def_property_readonly("name", [](const KeptModel& self) { return self.model.valve.name; })
      .def_property_readonly("rated_flow_m3_per_s",
                             [](const KeptModel& self) { return self.model.valve.rated_flow_m3_per_s; })
      .def_property_readonly("stroke_m", [](const KeptModel& self) { return self.model.valve.stroke_m; })
      .def_property_readonly(
          "direction",
          [](const KeptModel& self) { return self.model.whole() ? std::string("both") : self.model.valve.direction; })
      .def_property_readonly("estimators", &estimators)
      .def_property_readonly("doubts", [](const KeptModel& self) { return self.model.provenance.doubts; })
      .def(py::pickle([](const KeptModel& self) { return py::make_tuple(self.text); },
                      [](const py::tuple& state) {
                        return std::make_shared<KeptModel>(state[0].cast<std::string>(), "a pickled model");
                      }));
  module.def("read_model",
             [](const std::filesystem::path& file) { return at_work([&](SignalCheck&) { return read_model(file); }); });
}

}  // namespace

void add_sensors(py::module_& module) {
  add_model(module);
  module.attr("status_bits") = status_bits();
  module.attr("L_min_per_m3_per_s") = units::litre_per_minute_per_m3_per_s;
  module.attr("Pa_per_bar") = units::pascal_per_bar;
  module.def("status_text", [](std::uint32_t status) {
    estimation::StatusText text;
    return std::string(text(static_cast<sensor::Status>(status)));
  });
  using Answer = sensor::Estimate<double>;
  py::class_<Answer>(module, "Answer")
      .def_readonly("flow_m3_per_s", &Answer::flow_m3_per_s)
      .def_readonly("flow_lower_m3_per_s", &Answer::flow_lower_m3_per_s)
      .def_readonly("flow_upper_m3_per_s", &Answer::flow_upper_m3_per_s)
      .def_readonly("pressure_difference_Pa", &Answer::pressure_difference_Pa)
      .def_readonly("magnetic_force_N", &Answer::magnetic_force_N)
      .def_readonly("spring_force_N", &Answer::spring_force_N)
      .def_readonly("flow_force_N", &Answer::flow_force_N)
      .def_readonly("friction_force_N", &Answer::friction_force_N)
      .def_property_readonly("status", [](const Answer& self) { return static_cast<std::uint32_t>(self.status); });
  py::class_<WorkingSensor>(module, "Sensor")
      .def(py::init([](const SharedModel& model, const std::string& estimator) {
        return std::make_unique<WorkingSensor>(model, estimator);
      }))
      .def("step", &WorkingSensor::step)
      .def("run", &WorkingSensor::run)
      .def_property_readonly("time_s", &WorkingSensor::time_s)
      .def("reset", &WorkingSensor::reset);
}

}  // namespace spoolflow::python
