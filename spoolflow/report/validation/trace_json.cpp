#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "spoolflow/report/figures/packed_numbers.hpp"
#include "spoolflow/report/text/number_text.hpp"
#include "spoolflow/report/validation/validation_figures.hpp"
#include "spoolflow/units/conversion.hpp"
#include "spoolflow/units/reader_unit.hpp"

namespace spoolflow::report {
namespace {

using Json = nlohmann::ordered_json;
using validation::TracedChannel;
using validation::TracedEstimator;

constexpr double flow_factor = units::litre_per_minute_per_m3_per_s;
constexpr double pressure_factor = 1 / units::pascal_per_bar;

/// In the usual unit: factor * SI + offset.
Json numbers(const std::vector<float>& values, double factor, double offset = 0) {
  PackedNumbers column = packed(values, factor);
  return {{"offset", column.offset + offset}, {"scale", column.scale}, {"values", std::move(column.base64)}};
}

Json channel(const TracedChannel& data, double factor, double offset = 0) {
  Json out{{"low", numbers(data.lowest, factor, offset)}};
  if (!data.highest.empty()) out["high"] = numbers(data.highest, factor, offset);
  return out;
}

/// How a series looks.
struct Look {
  std::string name, tone;
  const char* shape = "line";
  double width_px = 1.4;
};

Json series(Json data, const Look& look) {
  Json out{{"name", look.name}, {"tone", look.tone}, {"shape", look.shape}, {"width", look.width_px}};
  out.update(data);
  return out;
}

Json line(const TracedChannel& data, double factor, const Look& look) {
  return series(channel(data, factor), look);
}

/// Its own force is read out; `top` is the edge that is drawn.
Json layer(const TracedChannel& force_N, const TracedChannel& top_N, const std::string& name, const std::string& tone) {
  Json out = series(channel(force_N, 1), {name, tone, "layer"});
  out["top"] = channel(top_N, 1);
  return out;
}

struct PanelLook {
  const char* title;
  std::string_view quantity;  ///< by the name of the page's chooser
  int height_px;
  bool from_zero;
};

/// Data come in the usual unit; the page's script turns them into the reader's.
std::string_view chooser_name(units::Kind kind) {
  return units::reader_quantity(kind).name;
}

Json panel(const PanelLook& look, Json all_series) {
  return {{"title", look.title},
          {"quantity", look.quantity},
          {"height", look.height_px},
          {"fromZero", look.from_zero},
          {"series", std::move(all_series)}};
}

class TraceJson {
 public:
  explicit TraceJson(const validation::RunResult& run) : run_(run), trace_(run.trace) {}

  [[nodiscard]] Json panels() const {
    Json out = Json::array();
    out.push_back(panel({"Flow rate", chooser_name(units::Kind::flow), 300, true}, flow()));
    if (run_.has_reference) {
      out.push_back(panel({"Error, estimated less measured", "error", 160, false},
                          of_every_estimator([](auto& each) { return channel(each.error_m3_per_s, flow_factor); })));
    }
    out.push_back(panel({"Pressure difference", chooser_name(units::Kind::pressure), 110, true}, pressure()));
    out.push_back(
        panel({"Position", chooser_name(units::Kind::length), 90, true},
              Json::array({line(trace_.position_m, units::millimetre_per_metre, {"measured", "ink", "line", 1.2})})));
    out.push_back(panel({"Forces on the spool", chooser_name(units::Kind::force), 190, true}, forces()));
    add_measured(out, {"Coil current", chooser_name(units::Kind::current), 90, false}, trace_.current_A, 0);
    add_measured(out, {"Coil voltage", chooser_name(units::Kind::voltage), 90, false}, trace_.voltage_V, 0);
    add_measured(out, {"Oil temperature", chooser_name(units::Kind::temperature), 70, false}, trace_.oil_temperature_K,
                 -units::kelvin_at_0_degC);
    return out;
  }

  [[nodiscard]] Json status() const {
    const std::vector<validation::StatusRow>& rows = run_.results.back().status;
    Json names = Json::array();
    for (const validation::StatusRow& row : rows) {
      names.push_back({{"name", row.name},
                       {"tone", row.fault ? "fault" : std::string(estimation::name(leading().estimator))},
                       {"bit", row.place},
                       {"share", fixed(100 * row.share, row.share < 0.01 ? 2 : 0) + " %"}});
    }
    return {{"title", fmt::format("Status of the {}", std::string(estimation::name(leading().estimator)))},
            {"names", std::move(names)},
            {"values", base64_of(leading().status)}};
  }

 private:
  /// A channel of the recording that has a panel to itself, where it was recorded.
  static void add_measured(Json& panels, const PanelLook& look, const TracedChannel& data, double offset) {
    if (data.lowest.empty()) return;
    panels.push_back(panel(look, Json::array({series(channel(data, 1, offset), {"measured", "ink", "line", 1.2})})));
  }

  [[nodiscard]] const TracedEstimator& leading() const { return trace_.estimators.back(); }

  /// `data_of(estimator)`: a packed channel.
  template <class DataOf>
  [[nodiscard]] Json of_every_estimator(const DataOf& data_of) const {
    Json out = Json::array();
    for (const TracedEstimator& each : trace_.estimators) {
      const double width_px = &each == &leading() ? 1.4 : 1;
      out.push_back(series(data_of(each), {std::string(estimation::name(each.estimator)),
                                           std::string(estimation::name(each.estimator)), "line", width_px}));
    }
    return out;
  }

  [[nodiscard]] Json flow() const {
    Json out = Json::array();
    Json band{{"low", numbers(leading().lower_m3_per_s, flow_factor)},
              {"high", numbers(leading().upper_m3_per_s, flow_factor)}};
    out.push_back(series(std::move(band), {"95 % band", std::string(estimation::name(leading().estimator)), "band"}));
    if (run_.has_reference) {
      out.push_back(line(trace_.reference_m3_per_s, flow_factor, {"measured", "ink", "line", 1.8}));
    }
    for (Json& each : of_every_estimator([](auto& one) { return channel(one.flow_m3_per_s, flow_factor); })) {
      out.push_back(std::move(each));
    }
    return out;
  }

  [[nodiscard]] Json pressure() const {
    Json out = Json::array();
    if (!trace_.pressure_difference_Pa.lowest.empty()) {
      out.push_back(line(trace_.pressure_difference_Pa, pressure_factor, {"measured", "ink", "line", 1.6}));
    }
    for (Json& each :
         of_every_estimator([](auto& one) { return channel(one.pressure_difference_Pa, pressure_factor); })) {
      out.push_back(std::move(each));
    }
    return out;
  }

  [[nodiscard]] Json forces() const {
    const TracedEstimator& says = leading();
    return Json::array({layer(says.spring_force_N, says.spring_force_N, "spring", "b"),
                        layer(says.flow_force_N, says.spring_and_flow_N, "flow force", "a"),
                        layer(says.friction_force_N, says.all_forces_N, "friction", "d"),
                        line(says.magnetic_force_N, 1, {"magnetic", "ink", "line", 1.4})});
  }

  const validation::RunResult& run_;
  const validation::RunTrace& trace_;
};

Json times(const std::vector<double>& time_s) {
  PackedTimes packed = packed_times(time_s);
  Json out{
      {"start", packed.start_s}, {"count", packed.count}, {packed.base64.empty() ? "step" : "tick", packed.step_s}};
  if (!packed.base64.empty()) out["values"] = std::move(packed.base64);
  return out;
}

}  // namespace

std::string trace_json(const validation::RunResult& run, double full_scale_m3_per_s) {
  if (run.trace.time_s.empty()) return {};
  const TraceJson trace(run);
  Json out{{"run", run.name},
           {"samplesPerStretch", run.trace.samples_per_stretch},
           {"fullScale", units::L_per_min_from_m3_per_s(full_scale_m3_per_s)},
           {"time", times(run.trace.time_s)},
           {"panels", trace.panels()}};
  if (!run.results.back().status.empty()) out["status"] = trace.status();
  std::string text = out.dump();
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");
  return text;
}

}  // namespace spoolflow::report
