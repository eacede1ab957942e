#include "spoolflow/apps/calibrate_type.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/apps/calibrate_work.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/progress.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/work/readable_model.hpp"
#include "spoolflow/calibration/type/several_units.hpp"
#include "spoolflow/calibration/type/type_model.hpp"

namespace spoolflow::apps {
namespace {

/// How far apart units of the type lie beside what was taken before.
void print_type(const calibration::SeveralUnits& compared, const calibration::Deviations& tolerances) {
  say("  {:<18} {:>10} {:>10}   from the middle\n", "between units", "tolerance", "spread");
  for (std::size_t k = 0; k < calibration::variations; ++k) {
    const calibration::VariationAbout& about = calibration::all_variations()[k];
    const auto [scale, unit_name] = calibration::written_unit(about.unit);
    const auto row = static_cast<Eigen::Index>(k);
    std::string units;
    for (const calibration::MeasuredUnit& unit : compared.units)
      units += fmt::format(" {:+.2g}", scale * unit.deviations[k]);
    say("  {:<18} {:>10.3g} {:>10.3g} {:<2}{}\n", about.name, scale * tolerances[k],
        scale * std::sqrt(compared.next.covariance(row, row)), unit_name, units);
  }
  for (const calibration::MeasuredUnit& unit : compared.units)
    say("  {}: {:.2g} N of its balance of forces are explained by none of them\n", unit.name, unit.force_left_N);
}

}  // namespace

void calibrate_type(const CalibrateArguments& arguments) {
  std::vector<recording::Campaign> campaigns;
  std::vector<std::filesystem::path> inputs;
  for (const std::string& file : arguments.campaigns) {
    campaigns.push_back(read_campaign(arguments, file));
    std::ranges::copy(files_of(campaigns.back()), std::back_inserter(inputs));
  }
  const calibration::Deviations tolerances = calibration::tolerances_of(campaigns);
  OutputFile output(arguments.model, inputs);
  Progress progress("calibrating", arguments.quiet);
  std::vector<model::Model> units;
  for (const recording::Campaign& campaign : campaigns) {
    const auto done = static_cast<double>(units.size());
    units.push_back(calibrated(campaign, arguments.despite_doubts, [&](const std::string& step, double share) {
      progress.task(fmt::format("{}: {}", campaign.valve.name, step));
      progress.update((done + share) / static_cast<double>(campaigns.size()));
    }));
    for (const std::string& doubt : units.back().provenance.doubts)
      say("spoolflow: doubt: {}: {}\n", campaign.valve.name, doubt);
  }
  const calibration::SeveralUnits compared = calibration::compare_units(units, tolerances);
  output.stream() << readable_text(calibration::type_of(units, compared), arguments.model);
  commit_together({&output});
  if (!arguments.quiet) print_type(compared, tolerances);
}

}  // namespace spoolflow::apps
