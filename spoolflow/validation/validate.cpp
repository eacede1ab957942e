#include "spoolflow/validation/validate.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/consistency/run_doubts.hpp"
#include "spoolflow/numerics/median.hpp"
#include "spoolflow/validation/judge_run.hpp"
#include "spoolflow/validation/judged_limits.hpp"
#include "spoolflow/validation/run_samples.hpp"

namespace spoolflow::validation {
namespace {

/// Gathers one estimator's samples of all runs.
struct Pool {
  ComparedSamples samples;
  std::vector<ErrorProfile> profiles;
  DirectionProfile direction;
  std::optional<SignFigures> sign = {};
};

std::string run_name(const std::filesystem::path& recording) {
  return recording == "-" ? "standard input" : recording.stem().string();
}

/// What names a run, and whether the calibration knows it.
struct RunName {
  std::string name, file, sha256;
  bool calibrated_with = false;
};

RunName name_of(const model::Model& model, const std::filesystem::path& recording) {
  RunName result;
  result.name = run_name(recording);
  result.file = recording == "-" ? "standard input" : recording.filename().string();
  std::error_code error;
  if (!std::filesystem::is_regular_file(recording, error)) return result;
  result.sha256 = model::sha256_of_file(recording);
  result.calibrated_with = std::any_of(model.provenance.inputs.begin(), model.provenance.inputs.end(),
                                       [&](const model::InputFile& input) { return input.sha256 == result.sha256; });
  return result;
}

PooledResult pooled_result(Pool pool, estimation::Estimator estimator) {
  PooledResult out{.estimator = estimator, .metrics = {}, .by_sample = {}, .profiles = std::move(pool.profiles)};
  if (pool.samples.size() == 0) return out;
  out.metrics = pool.samples.metrics(Weigh::runs);
  out.by_sample = pool.samples.metrics(Weigh::samples);
  out.direction = std::move(pool.direction);
  out.sign = pool.sign;
  return out;
}

/// `before`: the runs that came before it.
void add_doubts(RunResult& result, const std::vector<RunResult>& before, const std::vector<consistency::Doubt>& found) {
  for (const consistency::Doubt& doubt : found) result.doubts.push_back(doubt.text);
  const auto same = std::ranges::find_if(
      before, [&](const RunResult& run) { return !result.sha256.empty() && run.sha256 == result.sha256; });
  if (same != before.end()) {
    const auto [first, second] = std::minmax(result.file, same->file);
    result.doubts.push_back(fmt::format("{}: the same run as {}, byte for byte; it counts twice", second, first));
  }
}

}  // namespace

Validation validate(const model::Model& model, const std::vector<std::filesystem::path>& recordings,
                    const ValidationOptions& options, const std::function<void(double)>& progress) {
  if (options.requirements) {
    std::vector<std::string> runs;
    for (const std::filesystem::path& recording : recordings) runs.push_back(run_name(recording));
    check_names(*options.requirements, runs, options.estimators);
  }
  Validation out{{}, {}, 0, options.apply_reference_lag, {}, {}};
  std::vector<RunName> names;
  for (const std::filesystem::path& recording : recordings) names.push_back(name_of(model, recording));
  out.held_out = std::ranges::any_of(names, [](const RunName& run) { return !run.calibrated_with; });
  std::vector<double> lags_s;
  std::vector<Pool> pools(options.estimators.size(), {ComparedSamples(model.valve.rated_flow_m3_per_s),
                                                      empty_profiles(model.valve),
                                                      empty_direction(model.valve),
                                                      {}});
  const std::vector<consistency::KnownValve> known = consistency::known_valve(model);
  const auto total = static_cast<double>(recordings.size());
  for (const std::filesystem::path& recording : recordings) {
    const RunName& named = names[out.runs.size()];
    const auto before = static_cast<double>(out.runs.size());
    RunSamples samples = estimate_run(model, recording, options.channels, options.estimators,
                                      [&](double share) { progress((before + share) / total); });
    JudgedRun judged = judge_run(model.valve, samples, options, options.traced_values / recordings.size());
    if (judged.result.has_reference) lags_s.push_back(judged.result.reference_meter.lag_s);
    judged.result.name = named.name;
    judged.result.file = named.file;
    judged.result.sha256 = named.sha256;
    judged.result.calibrated_with = named.calibrated_with;
    add_doubts(judged.result, out.runs, consistency::doubts_about(known, samples.means, recording));
    const bool counts = !named.calibrated_with || !out.held_out;
    for (std::size_t e = 0; counts && e < judged.compared.size(); ++e) {
      pools[e].samples.append(judged.compared[e]);
      for (std::size_t q = 0; q < quantities.size(); ++q) {
        pools[e].profiles[q].append(judged.result.results[e].profiles[q]);
      }
      if (judged.result.results[e].direction) pools[e].direction.append(*judged.result.results[e].direction);
      if (const auto& sign = judged.result.results[e].sign) {
        if (!pools[e].sign) pools[e].sign.emplace();
        pools[e].sign->append(*sign);
      }
    }
    out.runs.push_back(std::move(judged.result));
  }
  if (!lags_s.empty()) out.reference_lag_s = numerics::median(std::move(lags_s));
  for (std::size_t e = 0; e < pools.size(); ++e) {
    out.pooled.push_back(pooled_result(std::move(pools[e]), options.estimators[e]));
  }
  if (options.requirements) {
    out.requirements_file = options.requirements->file;
    out.limits = judge(*options.requirements, out, model.valve.rated_flow_m3_per_s);
  }
  return out;
}

}  // namespace spoolflow::validation
