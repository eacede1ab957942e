#include "addons/fleet/worker.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
#include <random>
#include <unistd.h>

#include <fmt/format.h>

#include "spoolflow/parallel/pace.hpp"

namespace spoolflow::fleet {
namespace {

/// Of one start of one program on one machine.
std::string owner_name(const std::string& name) {
  std::string machine(64, '\0');
  if (name.empty() && ::gethostname(machine.data(), machine.size() - 1) != 0) machine = "worker";
  return fmt::format("{}-{}-{:08x}", name.empty() ? machine.c_str() : name.c_str(), ::getpid(), std::random_device{}());
}

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds spread_every{1};
/// What a partition waits for, servers that do not answer among it, ends sooner, by itself and with a word.
constexpr std::chrono::seconds stands_after{2 * worker_patience};

}  // namespace

/// One partition's thread. What ends it is reported once; the keeper then starts again, with another epoch.
struct Worker::Task {
  Claim claim;
  std::atomic<bool> ended = false;
  std::atomic<Clock::time_point> moved = Clock::now();
  bool stands = false;
  bool is_given = false;  ///< to others, once it has ended
  std::jthread thread{};
};

Worker::Worker(FleetSettings settings, std::string program, std::function<void(const std::string&)> report)
    : settings_(std::move(settings)),
      program_(std::move(program)),
      owner_(owner_name(settings_.worker.name)),
      report_(std::move(report)) {
  nats_ = std::make_unique<Connection>(access_of(settings_.servers, settings_.login), owner_);
  try {
    Session session(settings_.connection, owner_, worker_patience);
    learn_settings(session);
  } catch (const ServerAway& error) {  // as later, too: it is waited for
    reported_ = error.what();
    report_(reported_);
  }
  keeper_ = std::jthread([this](const std::stop_token& stop) { keep_share(stop); });
}

void Worker::learn_settings(Session& session) {
  shared_ = read_settings(session);
  if (shared_.partitions != partition_count) {
    throw ServerRefuses(fmt::format("the fleet has {} partitions, this program knows {}; use the program that made it",
                                    shared_.partitions, partition_count));
  }
}

Worker::~Worker() {
  stop();
}

void Worker::stop() {
  keeper_ = {};
  for (const auto& [partition, task] : tasks_) task->thread.request_stop();
  const bool has_partitions = !tasks_.empty() || !leaving_.empty();
  tasks_.clear();
  leaving_.clear();
  if (!has_partitions) return;
  try {
    Session session(settings_.connection, owner_, worker_patience);
    leave(session, owner_);
  } catch (const std::exception&) {  // the lease ends by itself
  }
}

void Worker::keep_share(const std::stop_token& stop) {
  std::optional<Session> session;
  parallel::SteadyTime next = Clock::now();
  do {
    try {
      if (!session) session.emplace(settings_.connection, owner_, worker_patience);
      if (shared_.partitions == 0) learn_settings(*session);
      spread(*session);
      report_nats_away();
      reported_.clear();
    } catch (const std::exception& error) {
      session.reset();
      if (reported_ != error.what()) report_(error.what());
      reported_ = error.what();
    }
    next = std::max(next + spread_every, Clock::now());
  } while (parallel::wait_until(next, stop));
}

/// Once, when it has been away for longer than a server takes to let somebody in.
void Worker::report_nats_away() {
  constexpr int patience = 5;
  away_ = nats_->connected() ? 0 : away_ + 1;
  if (away_ == patience)
    report_("NATS: no server can be reached, or none lets this user in; it is tried again and again");
}

/// Partitions whose thread hangs in something that has no end: their leases run out, and the worker that takes them
/// raises the epoch, so that the thread can keep nothing should it come back.
std::vector<Claim> Worker::standing() {
  std::vector<Claim> out;
  const auto look = [&](Task& task) {
    if (task.ended || Clock::now() - task.moved.load() < stands_after) return;
    if (!task.stands) {
      report_(fmt::format(
          "partition {}: has stood for {} s; it is left to any worker that takes it, this thread is given up",
          task.claim.partition, stands_after.count()));
    }
    task.stands = true;
    out.push_back(task.claim);
  };
  for (const auto& [partition, task] : tasks_) look(*task);
  for (const auto& task : leaving_) look(*task);
  return out;
}

void Worker::spread(Session& session) {
  const Spread now = renew(session, owner_, settings_.worker.lease_s, standing());
  std::map<std::int64_t, std::int64_t> mine;  // epochs by partition
  for (const Claim& one : now.held) mine[one.partition] = one.epoch;
  for (auto task = tasks_.begin(); task != tasks_.end();) {
    const auto held = mine.find(task->first);
    const bool lost = held == mine.end() || held->second != task->second->claim.epoch;
    if (!lost && !task->second->ended) {
      ++task;
      continue;
    }
    task->second->thread.request_stop();
    leaving_.push_back(std::move(task->second));  // where it was lost its next commit fails
    task = tasks_.erase(task);
  }
  see_off(session);
  for (const Claim& one : now.held) {
    const bool still_ends = std::any_of(leaving_.begin(), leaving_.end(), [&](const auto& task) {
      return task->claim.partition == one.partition && task->claim.epoch == one.epoch;
    });
    if (tasks_.contains(one.partition) || still_ends) continue;
    if (const auto again = claim_again(session, owner_, one.partition)) begin(*again);
  }
  const std::int64_t fair = (shared_.partitions + now.workers - 1) / now.workers;
  const auto count = static_cast<std::int64_t>(tasks_.size());
  if (count < fair) {
    for (const Claim& one : claim(session, owner_, settings_.worker.lease_s, fair - count)) begin(one);
  }
  for (std::int64_t surplus = count - fair; surplus > 0; --surplus) {
    const auto last = std::prev(tasks_.end());
    last->second->is_given = true;
    last->second->thread.request_stop();
    leaving_.push_back(std::move(last->second));
    tasks_.erase(last);
  }
}

/// Those that have ended: a thread may wait for servers for seconds, in which all leases would run out.
void Worker::see_off(Session& session) {
  for (auto task = leaving_.begin(); task != leaving_.end();) {
    if (!(*task)->ended) {
      ++task;
      continue;
    }
    if ((*task)->is_given) release(session, (*task)->claim);
    task = leaving_.erase(task);
  }
}

void Worker::begin(const Claim& claim) {
  auto task = std::make_unique<Task>();
  task->claim = claim;
  task->thread = std::jthread([this, at = task.get()](const std::stop_token& stop) {
    try {
      PartitionWork({settings_, shared_, program_, *nats_, models_, report_}, at->claim).run(stop, [at] {
        at->moved = Clock::now();
      });
    } catch (const std::exception& error) {
      report_(fmt::format("partition {}: {}", at->claim.partition, error.what()));
    }
    at->ended = true;
  });
  tasks_[claim.partition] = std::move(task);
}

}  // namespace spoolflow::fleet
