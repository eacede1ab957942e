#include "spoolflow/validation/validate.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/numerics/median.hpp"
#include "spoolflow/plausibility/run_findings.hpp"
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
  result.calibrated_with = std::ranges::any_of(
      model.provenance.inputs, [&](const model::InputFile& input) { return input.sha256 == result.sha256; });
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

/// `before`: the runs that stand before it.
void add_findings(RunResult& result, std::span<const RunName> before, const std::vector<plausibility::Finding>& found) {
  for (const plausibility::Finding& finding : found) result.doubts.push_back(finding.text);
  const auto same = std::ranges::find_if(
      before, [&](const RunName& run) { return !result.sha256.empty() && run.sha256 == result.sha256; });
  if (same != before.end()) {
    const auto [first, second] = std::minmax(result.file, same->file);
    result.doubts.push_back(fmt::format("{}: the same run as {}, byte for byte; it counts twice", second, first));
  }
}

/// Judges runs, each once and in any order.
class RunJudge {
 public:
  RunJudge(const model::Model& model, const std::vector<std::filesystem::path>& recordings,
           const ValidationOptions& options)
      : model_(model),
        options_(options),
        known_(plausibility::known_valve(model)),
        pools_(options.estimators.size(), {ComparedSamples(model.valve.rated_flow_m3_per_s),
                                           empty_profiles(model.valve),
                                           empty_direction(model.valve),
                                           {}}) {
    for (const std::filesystem::path& recording : recordings) names_.push_back(name_of(model, recording));
    out_.reference_lag_applied = options.apply_reference_lag;
    out_.held_out = std::ranges::any_of(names_, [](const RunName& run) { return !run.calibrated_with; });
    out_.runs.resize(recordings.size());
  }

  /// `k`: which of the recordings it is.
  void judge(std::size_t k, const std::filesystem::path& recording, RunSamples& samples, const KnownMeter& meter) {
    const RunName& named = names_[k];
    JudgedRun judged = judge_run(model_.valve, samples, meter, options_, options_.traced_values / names_.size());
    judged.result.name = named.name;
    judged.result.file = named.file;
    judged.result.sha256 = named.sha256;
    judged.result.calibrated_with = named.calibrated_with;
    add_findings(judged.result, std::span(names_).first(k),
                 plausibility::run_findings(known_, samples.means, recording));
    std::ranges::move(samples.contradictions, std::back_inserter(judged.result.doubts));
    if (!named.calibrated_with || !out_.held_out) pool(judged);
    out_.runs[k] = std::move(judged.result);
  }

  /// `meter`: of all runs together.
  Validation finish(const KnownMeter& meter) {
    out_.reference_lag_s = meter.meter.lag_s;
    for (std::size_t e = 0; e < pools_.size(); ++e) {
      out_.pooled.push_back(pooled_result(std::move(pools_[e]), options_.estimators[e]));
    }
    if (options_.requirements) {
      out_.requirements_file = options_.requirements->file;
      out_.limits = validation::judge(*options_.requirements, out_, model_.valve.rated_flow_m3_per_s);
    }
    return std::move(out_);
  }

 private:
  void pool(JudgedRun& judged) {
    for (std::size_t e = 0; e < judged.compared.size(); ++e) {
      pools_[e].samples.append(judged.compared[e]);
      for (std::size_t q = 0; q < quantities.size(); ++q) {
        pools_[e].profiles[q].append(judged.result.results[e].profiles[q]);
      }
      if (judged.result.results[e].direction) pools_[e].direction.append(*judged.result.results[e].direction);
      if (const auto& sign = judged.result.results[e].sign) {
        if (!pools_[e].sign) pools_[e].sign.emplace();
        pools_[e].sign->append(*sign);
      }
    }
  }

  const model::Model& model_;
  const ValidationOptions& options_;
  std::vector<plausibility::KnownValve> known_;
  std::vector<Pool> pools_;
  std::vector<RunName> names_;
  Validation out_;
};

/// The one meter behind several runs: medians of what they show.
KnownMeter common_meter(const std::vector<numerics::MeterLag>& shown) {
  if (shown.empty()) return {};
  std::vector<double> dead_times_s, lags_s;
  for (const numerics::MeterLag& meter : shown) {
    dead_times_s.push_back(meter.dead_time_s);
    lags_s.push_back(meter.lag_s);
  }
  return {
      {numerics::median(std::move(dead_times_s)), numerics::median(std::move(lags_s))}, {}, MeterSource::other_runs};
}

}  // namespace

Validation validate(const model::Model& model, const std::vector<std::filesystem::path>& recordings,
                    const ValidationOptions& options, const std::function<void(double)>& progress) {
  if (options.requirements) {
    std::vector<std::string> runs;
    for (const std::filesystem::path& recording : recordings) runs.push_back(run_name(recording));
    check_names(*options.requirements, runs, options.estimators);
  }
  RunJudge judge(model, recordings, options);
  std::vector<numerics::MeterLag> shown;
  std::vector<std::pair<std::size_t, RunSamples>> without_meter;
  const auto total = static_cast<double>(recordings.size());
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    RunSamples samples = estimate_run(model, recordings[k], options.channels, options.estimators,
                                      [&](double share) { progress((static_cast<double>(k) + share) / total); });
    KnownMeter meter{{.lag_s = options.reference_lag_s.value_or(0)}, {}, MeterSource::given};
    if (!options.reference_lag_s) meter = meter_of(model, samples);
    if (meter.source == MeterSource::none && !samples.reference_m3_per_s.empty()) {
      without_meter.emplace_back(k, std::move(samples));
      continue;
    }
    if (!samples.reference_m3_per_s.empty()) shown.push_back(meter.meter);
    judge.judge(k, recordings[k], samples, meter);
  }
  const KnownMeter common = common_meter(shown);
  for (auto& [k, samples] : without_meter) judge.judge(k, recordings[k], samples, common);
  return judge.finish(common);
}

}  // namespace spoolflow::validation
