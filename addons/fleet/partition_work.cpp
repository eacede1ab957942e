#include "addons/fleet/partition_work.hpp"

#include <thread>
#include <utility>

#include <fmt/format.h>

#include "addons/fleet/subjects.hpp"
#include "spoolflow/model/model_error.hpp"

namespace spoolflow::fleet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Blocks of one fetch; of one transaction at most; of one valve that came before their turn.
constexpr int fetched_blocks = 64;
constexpr std::size_t committed_blocks = 512, early_blocks = 256;
/// A sender of one valve may be one of many: what waits of all of them, and how many there are of a partition.
constexpr std::size_t most_early_bytes = std::size_t{1} << 26U, most_valves = 16384;
constexpr milliseconds patience{100}, retry{300};
/// A site sends again by itself what is not covered in time; asking is quicker where a single block is missing.
constexpr seconds ask_every{1}, publish_all_every{5};

}  // namespace

PartitionWork::PartitionWork(WorkerParts parts, const Claim& claim)
    : parts_(std::move(parts)),
      claim_(claim),
      session_(parts_.settings.connection, fmt::format("spoolflow partition {}", claim.partition), worker_patience),
      store_(session_, claim, parts_.settings.worker.lease_s),
      models_(parts_.nats.subscribe(model_subject("*"))) {
  restore();
}

void PartitionWork::restore() {
  stream_ = store_.stream_position();
  for (const KeptValve& kept : store_.read()) {
    const std::string& valve = kept.position.state.valve;
    const auto its_model = model(kept.position.model_sha256);
    if (!its_model) {
      throw ServerRefuses(
          fmt::format("the model {} of {} is missing or damaged; restore a backup", kept.position.model_sha256, valve));
    }
    place(valve).line.restore(kept, *its_model);
    to_publish_.insert(valve);
  }
}

/// From what is kept, after the store has refused what a valve gave: which of its blocks it is for is found out by
/// committing them one by one, and nothing is made of that one then.
void PartitionWork::restart(const ValveRefused& why) {
  const auto found = places_.find(why.valve);
  if (found == places_.end() || found->second.uncommitted == 0) throw ServerRefuses(why.what());
  const BlockPlace last = found->second.line.last();
  if (!suspects_.refused(why.valve, last, found->second.uncommitted, why.what())) {
    parts_.report(fmt::format("partition {}: {} stands at block {} until a worker takes the partition again: {}",
                              claim_.partition, why.valve, last.number, why.what()));
  }
  gathered_.clear();
  places_.clear();
  to_publish_.clear();
  set_aside_ = {};
  puller_.reset();
  uncommitted_ = early_bytes_ = 0;
  restore();
}

PartitionWork::Place& PartitionWork::place(const std::string& valve) {
  const live::AlarmDelays delays{parts_.shared.raised_after_s, parts_.shared.gone_after_s};
  return places_.try_emplace(valve, valve, parts_.program, delays).first->second;
}

/// Nothing where the store does not have it: rows refer to it. Sensor and monitor share what any partition has read.
std::optional<live::SharedModel> PartitionWork::model(const std::string& sha256) {
  auto found = parts_.models.find(sha256);
  if (found && kept_models_.contains(sha256)) return found;
  const auto kept = store_.model(sha256);
  if (!kept) return std::nullopt;
  kept_models_.insert(sha256);
  return found ? found : parts_.models.add(sha256, *kept);
}

/// What sites sent because it was asked for, by whomever.
void PartitionWork::take_models() {
  constexpr std::size_t hash_digits = 64;
  while (const auto message = models_.next(milliseconds(0))) {
    if (message->bytes.size() <= hash_digits) continue;
    const std::string sha256 = message->bytes.substr(0, hash_digits);
    if (kept_models_.contains(sha256)) continue;
    const std::vector<std::uint8_t> packed(message->bytes.begin() + hash_digits, message->bytes.end());
    try {
      if (!parts_.models.add(sha256, packed)) continue;
      store_.keep_model(sha256, packed);
      kept_models_.insert(sha256);
    } catch (
        const model::ModelError&) {  // of another version of the program: its blocks wait for a worker that knows it
    }
  }
}

/// It is made again where it is gone, but not at once: a server that deletes a large stream goes on with that behind
/// its answer, and would take the files of the new one, which then keeps nothing.
StreamPlace PartitionWork::stream_there() {
  constexpr std::chrono::seconds made_again_after{5};
  if (const auto there = parts_.nats.stream(parts_.settings.stream.name)) {
    gone_since_.reset();
    return *there;
  }
  const Clock::time_point now = Clock::now();
  if (!gone_since_) gone_since_ = now;
  if (now - *gone_since_ < made_again_after) throw TransportError("NATS: the stream is gone");
  return parts_.nats.make_stream(parts_.settings.stream);
}

/// Read from the beginning where it is not the one of before.
void PartitionWork::open_stream() {
  const StreamPlace there = stream_there();
  const bool same = there.created_ns == stream_.created_ns && stream_.sequence <= there.last;
  if (!same) stream_ = {there.created_ns, 0};
  puller_.emplace(parts_.nats.pull(parts_.settings.stream.name, fmt::format("spoolflow.block.{}.>", claim_.partition),
                                   stream_.sequence + 1, silent_readers_));
}

/// False where the stream is away.
bool PartitionWork::fetch() {
  try {
    if (!puller_) open_stream();
    for (const Message& message : puller_->fetch(fetched_blocks, patience)) take(message);
    work();
    return true;
  } catch (const TransportError&) {
    if (puller_) silent_readers_ = puller_->has_spoken() ? 0 : silent_readers_ + 1;
    puller_.reset();
    return false;
  }
}

/// With the reason and without content where that is wrong: what was sent for good is passed over, not waited for.
/// Nothing where it is not known whose it is, or where another program or another try may read it.
std::optional<Block> PartitionWork::whole_block(const Message& message) {
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(message.bytes.data()), message.bytes.size());
  auto read = read_block(bytes);
  std::optional<Block> out;
  std::string_view reason;
  if (Block* const block = std::get_if<Block>(&read)) {
    out = std::move(*block);
  } else {
    reason = name(std::get<NoBlock>(read));
    out = read_block_header(bytes);
    if (out) out->set_aside = reason;
  }
  // A site speaks for its own valves alone, which the server sees to by the subject.
  if (out && (message.subject != block_subject(claim_.partition, site_of(out->valve)) ||
              partition_of(out->valve) != claim_.partition)) {
    set_aside_.add(message, &*out, "of a valve that its subject does not carry");
    return std::nullopt;
  }
  if (!reason.empty()) set_aside_.add(message, out ? &*out : nullptr, reason);
  return out;
}

void PartitionWork::take(const Message& message) {
  stream_.sequence = message.sequence;
  std::optional<Block> block = whole_block(message);
  if (!block || suspects_.stands(block->valve)) return;
  if (places_.size() >= most_valves && !places_.contains(block->valve)) {
    set_aside_.add(message, &*block, fmt::format("of a valve more than the {} of a partition", most_valves));
    return;
  }
  Place& at = place(block->valve);
  if (at.gathered) work();  // whose turn it is depends on the block before
  switch (at.line.turn(*block)) {
    case ValveLine::Turn::next:
      if (gather(at, *block)) return;
      [[fallthrough]];
    case ValveLine::Turn::early:
      return keep_early(at, std::move(*block));
    case ValveLine::Turn::duplicate:
      to_publish_.insert(block->valve);  // its site seems not to have heard
  }
}

/// False where its model is not there yet, or a block before it is to be committed first; it is then left as it is.
bool PartitionWork::gather(Place& at, Block& block) {
  if (at.uncommitted > 0 && suspects_.has(block.valve)) return false;  // each by itself
  auto its_model = model(block.model_sha256);
  if (!its_model) {
    ask(block.valve, at, "model " + block.model_sha256);
    return false;
  }
  if (const auto reason = suspects_.reason(block.valve, {block.session, block.number})) {
    set_aside_.add(block, block_subject(claim_.partition, site_of(block.valve)), *reason);
    block.samples.clear();
    block.report.reset();
    block.set_aside = *reason;
  }
  at.gathered = true;
  gathered_.push_back({&at, std::move(block), std::move(*its_model)});
  return true;
}

/// What finds no room is sent again.
void PartitionWork::keep_early(Place& at, Block&& block) {
  const std::size_t content =
      block.report ? 4 * write_report(*block.report).size() : block.samples.size() * sizeof(estimation::TimedSample);
  const std::size_t bytes = sizeof(Early) + content;
  if (at.early.size() >= early_blocks || early_bytes_ + bytes > most_early_bytes) return;
  const std::pair place{block.session, block.number};
  if (at.early.try_emplace(place, Early{std::move(block), bytes}).second) early_bytes_ += bytes;
}

/// Of what came before its turn, the block that has it now.
void PartitionWork::gather_early(Place& at) {
  while (!at.early.empty() && !at.gathered) {
    const auto first = at.early.begin();
    const ValveLine::Turn turn = at.line.turn(first->second.block);
    if (turn == ValveLine::Turn::early) return;
    if (turn == ValveLine::Turn::next && !gather(at, first->second.block)) return;
    early_bytes_ -= first->second.bytes;
    at.early.erase(first);
  }
}

/// On all that is gathered, and on what has its turn then.
void PartitionWork::work() {
  while (!gathered_.empty()) {
    const std::vector<Gathered> now = std::exchange(gathered_, {});
    for (const auto& [at, block, its_model] : now) {
      at->gathered = false;
      ++at->uncommitted;
      at->line.work(block, its_model);
    }
    uncommitted_ += now.size();
    for (const Gathered& one : now) gather_early(*one.at);
  }
}

void PartitionWork::ask(const std::string& valve, Place& at, const std::string& what) {
  const Clock::time_point now = Clock::now();
  if (now - at.asked < ask_every) return;
  at.asked = now;
  parts_.nats.publish(ask_subject(site_of(valve)), what);
}

void PartitionWork::ask_for_missing() {
  for (auto& [valve, at] : places_) gather_early(at);  // a model may have come
  work();
  for (auto& [valve, at] : places_) {
    if (at.early.empty() || at.line.turn(at.early.begin()->second.block) != ValveLine::Turn::early) continue;
    // Of another store of its site it misses the first.
    const bool same_store = at.early.begin()->second.block.session == at.line.last().session;
    ask(valve, at, fmt::format("blocks {} {}", id_of(valve), same_store ? at.line.last().number + 1 : 1));
  }
}

void PartitionWork::commit() {
  work();  // where asking failed on the way: the place in the stream is behind what is gathered
  committed_ = Clock::now();
  std::vector<Acknowledgement> seen = store_.acknowledgements();
  for (Acknowledgement& one : seen) one.taken = place(one.valve).line.acknowledge(one);
  std::vector<ValveRows> rows;
  for (auto& [valve, at] : places_) {
    auto one = at.line.take_rows();
    if (!one) continue;
    to_publish_.insert(valve);
    rows.push_back(std::move(*one));
  }
  uncommitted_ = 0;
  if (!rows.empty() || !seen.empty() || set_aside_.waiting().count > 0) {
    try {
      const auto first_seen = store_.commit(rows, seen, set_aside_.waiting(), stream_);
      for (const std::string& line : set_aside_.committed(claim_.partition, first_seen)) parts_.report(line);
    } catch (const ValveRefused& error) {
      return restart(error);
    }
  }
  for (auto& [valve, at] : places_) {
    if (std::exchange(at.uncommitted, 0) > 0) suspects_.committed(valve, at.line.last());
  }
  publish_coverage(false);
}

/// Of what is committed alone: called behind a commit.
void PartitionWork::publish_coverage(bool all) {
  std::map<std::string, std::string> lines;  // by site
  for (const auto& [valve, at] : places_) {
    const BlockPlace& last = at.line.last();
    if (last.session == 0 || (!all && !to_publish_.contains(valve))) continue;
    lines[site_of(valve)] += fmt::format("{} {} {}\n", id_of(valve), last.session, last.number);
  }
  to_publish_.clear();
  for (const auto& [site, text] : lines) parts_.nats.publish(coverage_subject(site), text);
}

void PartitionWork::run(const std::stop_token& stop, const std::function<void()>& moved) {
  const auto commit_every = std::chrono::duration<double>(parts_.settings.worker.commit_s);
  while (!stop.stop_requested()) {
    moved();
    if (!puller_ && uncommitted_ > 0) commit();  // what follows may wait for servers
    if (!fetch()) std::this_thread::sleep_for(retry);
    take_models();
    ask_for_missing();
    const Clock::time_point now = Clock::now();
    const bool waits = uncommitted_ < committed_blocks && now - committed_ < commit_every;
    if (waits && (!suspects_.any() || uncommitted_ == 0)) continue;
    commit();
    if (now - published_ < publish_all_every) continue;
    published_ = now;
    publish_coverage(true);
  }
  commit();
}

}  // namespace spoolflow::fleet
