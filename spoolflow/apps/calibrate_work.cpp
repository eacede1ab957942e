#include "spoolflow/apps/calibrate_work.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/apps/terminal/input_kind.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/report/calibration/calibration_summary.hpp"
#include "spoolflow/report/validation/validation_report.hpp"
#include "spoolflow/sensor/band.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::apps {
namespace {

void print_summary(const model::Model& model) {
  if (model.whole()) {
    for (const char* direction : {"b", "a"}) {
      say("flow P to {}\n", *direction == 'a' ? "A" : "B");
      print_summary(model::of_direction(model, direction));
    }
    return;
  }
  const model::Condensed& condensed = model.condensed;
  say("{}: currents to {:.3g} A, positions to {:.3g} mm, pressure differences {:.3g} to {:.3g} bar\n", model.valve.name,
      condensed.current_A.upper, units::mm_from_m(condensed.position_m.upper),
      units::bar_from_Pa(condensed.pressure_difference_Pa.lower),
      units::bar_from_Pa(condensed.pressure_difference_Pa.upper));
  for (const report::SummaryLine& line : report::calibration_summary(model)) {
    say("  {:<40} {:>9} {:<6} usually {}{}\n", line.of, line.value, line.unit, line.usually,
        line.usual ? "" : "  <- UNUSUAL");
  }
  const model::Uniqueness& uniqueness = model.evidence.uniqueness;
  say("  flow force determines the flow above {:.3g} mm of opening{}\n", units::mm_from_m(uniqueness.blind_below_m),
      uniqueness.ambiguous_at_m.empty()
          ? ""
          : fmt::format(", but is ambiguous at {} position{} (see the model's evidence)",
                        uniqueness.ambiguous_at_m.size(), uniqueness.ambiguous_at_m.size() == 1 ? "" : "s"));
  if (model.observer && std::ranges::count(model.observer->defaults, model::each_edge_alone) > 0) {
    fmt::print(stderr,
               "  A and B were joined, and the load passes unequal flows over both edges: they are assumed equal, and "
               "the band is {:.2g} L/min wider to either side; measure one edge at a time to know\n",
               units::litre_per_minute_per_m3_per_s * sensor::flow_residual_factor *
                   model.observer->parameters.band.flow_residual_m3_per_s);
  }
}

}  // namespace

std::vector<std::filesystem::path> files_of(const recording::Campaign& campaign) {
  std::vector<std::filesystem::path> files{campaign.file};
  for (const recording::CampaignRecording& recording : campaign.recordings) files.push_back(recording.file);
  return files;
}

recording::Campaign read_campaign(const CalibrateArguments& arguments, const std::string& file) {
  refuse_other_kinds("calibrate", {{file, FileKind::settings}});
  return recording::read_campaign(
      file, arguments.allow_outside ? recording::OutsideFiles::allowed : recording::OutsideFiles::refused);
}

model::Model calibrated(const recording::Campaign& campaign, bool despite_doubts,
                        const calibration::CalibrationProgress& progress) {
  return calibration::calibrate(
      campaign, std::string(tool_version()), progress,
      despite_doubts ? calibration::Contradictions::noted : calibration::Contradictions::refused);
}

void calibrate_one(const CalibrateArguments& arguments, const CalibrationTask& task,
                   const std::function<MadeModel(const recording::Campaign&)>& make) {
  const recording::Campaign campaign = read_campaign(arguments, task.campaign);
  const report::ReaderUnits units(arguments.units);
  Outputs outputs(files_of(campaign));
  OutputFile& output = outputs.open(task.model);
  OutputFile* const page = outputs.open_if_named(task.report);
  const auto [model, text] = make(campaign);
  for (const model::InputFile& input : model.provenance.inputs) {
    if (!input.resampled.empty()) say("{}: {}\n", input.file, input.resampled);
  }
  for (const std::string& doubt : model.provenance.doubts) say("spoolflow: doubt: {}\n", doubt);
  output.stream() << text;
  if (page != nullptr) report::write_calibration_report(page->stream(), model, units);
  outputs.commit();
  if (!arguments.quiet) print_summary(model);
}

}  // namespace spoolflow::apps
