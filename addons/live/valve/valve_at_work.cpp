#include "addons/live/valve/valve_at_work.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include <fmt/format.h>

#include "addons/live/blocks/steps.hpp"
#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/estimation/state_check.hpp"
#include "spoolflow/numerics/crc32.hpp"
#include "spoolflow/numerics/number_check.hpp"
#include "spoolflow/numerics/padding.hpp"

namespace spoolflow::live {
namespace {

/// What is kept of a state, behind what is there already. Equal states have equal bytes.
template <class State>
void put_bytes(std::vector<std::byte>& out, State state) {
  static_assert(std::is_trivially_copyable_v<State>);
  numerics::clear_padding(state);
  const auto bytes = std::as_bytes(std::span(&state, 1));
  out.insert(out.end(), bytes.begin(), bytes.end());
}

/// Takes it off the front. False where there is not enough.
template <class State>
bool take_bytes(std::span<const std::byte>& from, State& state) {
  if (from.size() < sizeof state) return false;
  std::memcpy(&state, from.data(), sizeof state);
  from = from.subspan(sizeof state);
  return true;
}

std::uint32_t sum_of(std::span<const std::byte> bytes) {
  return numerics::crc32({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

SourceCounts sum(const SourceCounts& before, const IntakeCounters& since) {
  return {before.dropped + since.dropped, before.lost + since.lost, before.repeated + since.repeated,
          before.unreadable + since.unreadable, before.connections + since.connections};
}

/// A step in which energy is counted; a longer one is a gap.
constexpr double longest_counted_step_s = 1;

}  // namespace

ValveAtWork::ValveAtWork(std::string id, SharedModel model, std::string_view program, double raw_s)
    : id_(std::move(id)),
      model_(std::move(model)),
      sensor_(estimation::running_sensor(*model_.model, estimation::best_estimator(*model_.model))),
      time_s_(std::numeric_limits<double>::quiet_NaN()),
      doubt_second_(std::numeric_limits<double>::quiet_NaN()),
      raw_(model_.model->whole(), raw_s) {
  if (model_.model->has_observer()) watch_.emplace(*model_.model);
  layout_ = fmt::format("{}, model {}, sensor {} bytes, doubt {} bytes, monitor {} bytes of version {}", program,
                        model_.sha256, sizeof(estimation::RunningState), sizeof(monitor::Doubt),
                        watch_ ? sizeof(monitor::MonitorState) : 0, monitor::watch_state_version);
}

bool ValveAtWork::restore(const KeptState& kept) {
  const std::lock_guard lock(mutex_);
  after_ = {kept.session, kept.next};
  counted_before_ = kept.counts;
  samples_ = kept.samples;
  energy_J_ = kept.energy_J;
  if (kept.layout != layout_) return false;
  std::span<const std::byte> bytes(kept.bytes);
  std::uint32_t sum = 0;
  if (bytes.size() < sizeof sum) return false;
  std::span<const std::byte> end = bytes.last(sizeof sum);
  bytes = bytes.first(bytes.size() - sizeof sum);
  if (!take_bytes(end, sum) || sum != sum_of(bytes)) return false;
  estimation::RunningState state;
  monitor::Doubt doubt;
  double doubt_second = 0;
  const void* const state_bytes = bytes.data();
  if (!take_bytes(bytes, state) || !estimation::may_be_running_state(state_bytes)) return false;
  if (!take_bytes(bytes, doubt) || !take_bytes(bytes, doubt_second) || !numerics::holds_numbers(doubt)) return false;
  if (watch_) {
    const auto watched = std::make_unique<monitor::MonitorState>();
    if (!take_bytes(bytes, *watched) || !watch_->set_state(*watched)) return false;
  }
  sensor_.set_state(state);
  doubt_ = doubt;
  doubt_second_ = doubt_second;
  if (state.times.started) time_s_ = state.times.last_time_s;
  return true;
}

/// Once a second of the source's clock, so that the same samples get the same answers at any speed: doubt changes with
/// the monitor's windows, which last longer.
void ValveAtWork::ask_doubt(double time_s) {
  const bool same_second = time_s >= doubt_second_ && time_s - doubt_second_ < 1;
  if (same_second || !std::isfinite(time_s)) return;
  doubt_second_ = std::floor(time_s);
  doubt_ = watch_->doubt();
}

void ValveAtWork::add_to_summary(const estimation::TimedSample& sample, const sensor::Estimate<double>& answer) {
  Summary& to = summary_;
  const double flow = answer.flow_m3_per_s;
  const bool first = to.samples == 0;
  ++to.samples;
  to.flow_min_m3_per_s = first ? flow : std::min(to.flow_min_m3_per_s, flow);
  to.flow_max_m3_per_s = first ? flow : std::max(to.flow_max_m3_per_s, flow);
  to.flow_mean_m3_per_s += (flow - to.flow_mean_m3_per_s) / static_cast<double>(to.samples);
  to.lower_min_m3_per_s =
      first ? answer.flow_lower_m3_per_s : std::min(to.lower_min_m3_per_s, answer.flow_lower_m3_per_s);
  to.upper_max_m3_per_s =
      first ? answer.flow_upper_m3_per_s : std::max(to.upper_max_m3_per_s, answer.flow_upper_m3_per_s);
  to.status |= static_cast<std::uint32_t>(answer.status);
  if (!std::isfinite(sample.time_s)) return;
  const double step_s = sample.time_s - time_s_;
  if (step_s > 0 && step_s <= longest_counted_step_s && !sensor::has(answer.status, monitor::uncounted)) {
    const double energy_J = std::abs(flow) * answer.pressure_difference_Pa * step_s;
    if (std::isfinite(energy_J)) {
      to.energy_J += energy_J;
      energy_J_ += energy_J;
    }
  }
  time_s_ = sample.time_s;
  to.time_s = sample.time_s;
}

void ValveAtWork::publish(std::string name, const OutboxPosition& after, const BlockLimits& limits) {
  const std::lock_guard lock(mutex_);
  cutter_.emplace(std::move(name), model_.sha256, after, limits);
}

void ValveAtWork::take(const estimation::TimedSample& sample, const sensor::Estimate<double>& answer) {
  if (cutter_) cutter_->add(sample);
  if (watch_) ask_doubt(sample.time_s);
  last_ = answer;
  if (watch_) watch_->take(sample, last_);
  if (doubt_.any()) {
    last_ = monitor::widened(*model_.model, doubt_, sample, watch_->state().oil_temperature_K, last_);
  }
  add_to_summary(sample, last_);
  raw_.add(sample);
  if (std::isfinite(sample.time_s)) trace_.add(sample.time_s, sample.position_m, sample.current_A, last_);
}

void ValveAtWork::work(const SampleBlock& block) {
  const std::lock_guard lock(mutex_);
  for (const estimation::TimedSample& came : block.samples) {
    const estimation::TimedSample sample = cutter_ ? fleet::on_grid(came) : came;
    take(sample, sensor_.step(sample));
  }
  end(block);
}

void ValveAtWork::end(const SampleBlock& block) {
  samples_ += block.samples.size();
  after_ = block.after;
  counted_ = block.counted;
  arrived_ns_ = block.arrived_ns;
}

void ValveAtWork::finish() {
  const std::lock_guard lock(mutex_);
  if (watch_) watch_->finish();
}

ValveView ValveAtWork::view(bool with_indicators) const {
  const std::lock_guard lock(mutex_);
  ValveView out;
  out.id = id_;
  out.rated_flow_m3_per_s = model_.model->valve.rated_flow_m3_per_s;
  out.time_s = arrived_ns_ == 0 ? std::numeric_limits<double>::quiet_NaN() : time_s_;
  out.answer = last_;
  out.doubted = doubt_.any();
  out.samples = samples_;
  out.energy_J = energy_J_;
  out.arrived_ns = arrived_ns_;
  if (watch_) {
    out.condition = watch_->condition();
    if (out.doubted) out.condition = std::max(out.condition, monitor::Ne107::maintenance_required);
    out.causes = watch_->causes();
    if (with_indicators) out.indicators = watch_->indicators();
  }
  return out;
}

std::int64_t ValveAtWork::arrived_ns() const {
  const std::lock_guard lock(mutex_);
  return arrived_ns_;
}

ValveAtWork::TracePart ValveAtWork::trace_from(std::uint64_t first) const {
  TracePart out{};
  const std::lock_guard lock(mutex_);
  out.first = trace_.copy_from(first, out.points);
  out.arrived_ns = arrived_ns_;
  return out;
}

std::string ValveAtWork::raw_csv(double from_s, double to_s) const {
  const std::lock_guard lock(mutex_);
  return raw_.csv(from_s, to_s);
}

std::uint64_t ValveAtWork::trace_size() const {
  const std::lock_guard lock(mutex_);
  return trace_.size();
}

ValveCommit ValveAtWork::take_commit(bool with_indicators) {
  ValveCommit out;
  const std::lock_guard lock(mutex_);
  out.since_last = std::exchange(summary_, {});
  if (cutter_) {
    out.blocks = cutter_->take();
    out.outbox_session = cutter_->position().session;
  }
  out.state = {id_, after_.session, after_.next, samples_, energy_J_, layout_, {}};
  out.state.counts = sum(counted_before_, counted_);
  std::vector<std::byte>& bytes = out.state.bytes;
  bytes.reserve(sizeof(estimation::RunningState) + sizeof(monitor::Doubt) + sizeof(double) +
                (watch_ ? sizeof(monitor::MonitorState) : 0) + sizeof(std::uint32_t));
  put_bytes(bytes, sensor_.state());
  put_bytes(bytes, doubt_);
  put_bytes(bytes, doubt_second_);
  if (watch_) put_bytes(bytes, watch_->state());
  put_bytes(bytes, sum_of(bytes));
  if (!watch_ || !with_indicators) return out;
  for (const monitor::Indicator& one : watch_->indicators()) {
    out.indicators.push_back({std::string(one.name), one.value, one.uncertainty_95, one.baseline,
                              std::string(monitor::name(one.state)), std::string(one.unit)});
  }
  return out;
}

Summary ValveAtWork::take_summary() {
  const std::lock_guard lock(mutex_);
  return std::exchange(summary_, {});
}

std::size_t ValveAtWork::give_back(const ValveCommit& commit) {
  const std::lock_guard lock(mutex_);
  const std::size_t given_up = cutter_ ? cutter_->give_back(commit.blocks) : 0;
  const Summary& before = commit.since_last;
  if (before.samples == 0) return given_up;
  if (summary_.samples == 0) {
    summary_ = before;
    return given_up;
  }
  Summary& now = summary_;
  const double all = static_cast<double>(now.samples + before.samples);
  now.flow_mean_m3_per_s = (now.flow_mean_m3_per_s * static_cast<double>(now.samples) +
                            before.flow_mean_m3_per_s * static_cast<double>(before.samples)) /
                           all;
  now.samples += before.samples;
  now.flow_min_m3_per_s = std::min(now.flow_min_m3_per_s, before.flow_min_m3_per_s);
  now.flow_max_m3_per_s = std::max(now.flow_max_m3_per_s, before.flow_max_m3_per_s);
  now.lower_min_m3_per_s = std::min(now.lower_min_m3_per_s, before.lower_min_m3_per_s);
  now.upper_max_m3_per_s = std::max(now.upper_max_m3_per_s, before.upper_max_m3_per_s);
  now.energy_J += before.energy_J;
  now.status |= before.status;
  return given_up;
}

}  // namespace spoolflow::live
