#include "spoolflow/fleet/publisher.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/fleet/blocks/block.hpp"
#include "spoolflow/fleet/models.hpp"
#include "spoolflow/fleet/settings.hpp"
#include "spoolflow/fleet/subjects.hpp"
#include "spoolflow/model/provenance.hpp"

namespace spoolflow::fleet {
namespace {

using std::chrono::milliseconds;

/// Blocks of one valve on their way at a time.
constexpr std::uint64_t window = 64;
/// The store is looked at so often; what is not covered within the patience is sent again, later and later.
constexpr milliseconds look_every{100}, first_patience{3000}, longest_patience{15000}, model_every{500};

}  // namespace

Publisher::Publisher(live::Engine& engine, std::function<void(const std::string&)> tell)
    : engine_(engine),
      tell_(std::move(tell)),
      nats_(access_of(engine.site().fleet.servers, engine.site().fleet.login), engine.site().fleet.site) {
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

Publisher::~Publisher() {
  thread_ = {};
}

void Publisher::run(const std::stop_token& stop) {
  const std::string& site = engine_.site().fleet.site;
  Subscription coverage = nats_.subscribe(coverage_subject(site));
  Subscription asks = nats_.subscribe(ask_subject(site));
  std::string told;
  while (!stop.stop_requested()) {
    try {
      const std::uint64_t mendings = engine_.store_view().mendings;
      live::Database database = live::open_store_to_read(engine_.site().store);
      while (!stop.stop_requested() && engine_.store_view().mendings == mendings) {
        hear(coverage, asks);
        const bool connected = nats_.connected();
        if (connected != was_connected_)
          tell_(connected ? "connected to the fleet" : "the fleet cannot be reached; blocks are kept");
        was_connected_ = connected;
        look_for_new(database);
        if (connected) send(database);
        told.clear();
      }
    } catch (const live::StoreError& error) {  // a disk that is full, or a store that is held for too long
      if (told != error.what()) tell_(error.what());
      told = error.what();
    }
  }
}

void Publisher::look_for_new(live::Database& database) {
  for (const live::OutboxPosition& one : live::outbox_positions(database)) {
    Progress& at = valves_[one.valve];
    if (at.session != one.session)
      at = {.session = one.session, .sent = one.covered, .covered = one.covered, .patience = first_patience};
    at.newest = one.number;
  }
}

void Publisher::hear(Subscription& coverage, Subscription& asks) {
  auto patience = look_every;
  while (const auto message = coverage.next(patience)) {
    take_coverage(message->bytes);
    patience = milliseconds(0);
  }
  while (const auto message = asks.next(milliseconds(0))) answer(message->bytes);
}

void Publisher::take_coverage(const std::string& text) {
  std::istringstream lines(text);
  std::string id;
  std::uint64_t session = 0, number = 0;
  while (lines >> id >> session >> number) {
    const auto found = valves_.find(id);
    if (found == valves_.end() || found->second.session != session) continue;
    Progress& at = found->second;
    if (number <= at.covered || number > at.newest) continue;
    at.covered = number;
    at.sent = std::max(at.sent, number);
    at.moved = Clock::now();
    at.patience = first_patience;
    engine_.covered(id, number);
  }
}

void Publisher::answer(const std::string& ask) {
  std::istringstream words(ask);
  std::string what, name;
  std::uint64_t number = 0;
  words >> what >> name >> number;
  if (what == "blocks") {
    const auto found = valves_.find(name);
    if (found != valves_.end() && number > found->second.covered) {
      found->second.sent = std::min(found->second.sent, number - 1);
    }
    return;
  }
  if (what == "model") send_model(name);
}

/// All workers hear it: one answer is enough where several ask at once.
void Publisher::send_model(const std::string& sha256) {
  SentModel& model = models_[sha256];
  const Clock::time_point now = Clock::now();
  if (!model.packed.empty() && now - model.sent < model_every) return;
  for (const live::ValveSettings& valve : engine_.site().valves) {
    if (!model.packed.empty()) break;
    if (valve.model.sha256 != sha256 || valve.model.file.empty()) continue;
    std::ifstream in(valve.model.file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    if (model::sha256_of_text(text) != sha256) {
      tell_(
          fmt::format("{}: is another model than when the program started; start it again", valve.model.file.string()));
      return;
    }
    const std::vector<std::uint8_t> packed = pack_model(text);
    model.packed = sha256 + std::string(packed.begin(), packed.end());
  }
  if (model.packed.empty()) return;
  model.sent = now;
  nats_.publish(model_subject(engine_.site().fleet.site), model.packed);
}

void Publisher::send(live::Database& database) {
  const Clock::time_point now = Clock::now();
  for (auto& [valve, at] : valves_) {
    if (at.sent > at.covered && now - at.moved > at.patience) {
      at.sent = at.covered;
      at.moved = now;
      at.patience = std::min(2 * at.patience, longest_patience);
    }
    if (at.sent < at.newest && at.sent < at.covered + window) send(database, valve, at);
  }
}

void Publisher::send(live::Database& database, const std::string& valve, Progress& at) {
  if (at.sent == at.covered) at.moved = Clock::now();
  const std::string& site = engine_.site().fleet.site;
  const std::string subject = block_subject(partition_of(fmt::format("{}/{}", site, valve)), site);
  for (live::OutboxBlock& one : live::blocks_of(database, valve, at.sent, std::min(at.newest, at.covered + window))) {
    if (one.number != at.sent + 1) {  // those between were given up: this one stands for them
      auto read = read_block(one.bytes);
      if (Block* const block = std::get_if<Block>(&read)) {
        block->first = at.sent + 1;
        one.bytes = write_block(*block);
      }
    }
    if (!nats_.publish(subject, one.bytes)) return;
    at.sent = one.number;
  }
}

}  // namespace spoolflow::fleet
