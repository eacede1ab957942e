#include "addons/fleet/publisher.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "addons/fleet/models.hpp"
#include "addons/fleet/settings.hpp"
#include "addons/fleet/subjects.hpp"
#include "addons/live/blocks/block.hpp"
#include "spoolflow/model/provenance.hpp"

namespace spoolflow::fleet {
namespace {

using std::chrono::milliseconds;

/// The store is looked at, and a model sent again, so often.
constexpr milliseconds look_every{100}, model_every{500};

constexpr const char* unreachable = "the fleet cannot be reached; blocks are kept";

}  // namespace

Publisher::Publisher(live::Engine& engine, std::function<void(const std::string&)> report)
    : engine_(engine),
      report_(std::move(report)),
      output_(engine.outputs().add("fleet")),
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
  std::string reported;
  while (!stop.stop_requested()) {
    try {
      const std::uint64_t mendings = engine_.store_view().mendings;
      live::Database database = live::open_store_to_read(engine_.site().store);
      while (!stop.stop_requested() && engine_.store_view().mendings == mendings) {
        hear(coverage, asks);
        const bool connected = nats_.connected();
        report_connection(connected);
        look_for_new(database);
        if (connected) {
          send(database);
          report_standstill();
        }
        output_->set_trouble(connected ? standing_ : unreachable);
        reported.clear();
      }
    } catch (const live::StoreError& error) {  // a disk that is full, or a store that is held for too long
      if (reported != error.what()) report_(error.what());
      reported = error.what();
      output_->set_trouble(reported);
    }
  }
}

void Publisher::look_for_new(live::Database& database) {
  for (const live::OutboxPosition& one : live::outbox_positions(database)) {
    Delivery& at = valves_[one.valve];
    if (at.session() != one.session) at = Delivery(one.session, one.covered);
    at.found(one.number);
  }
  std::uint64_t waiting = 0;
  for (const auto& [valve, at] : valves_) waiting += at.waiting();
  output_->waiting = waiting;
}

void Publisher::report_connection(bool connected) {
  if (!connected) {
    standstill_.away();
    standing_.clear();
  }
  if (connected == (output_->connected > 0)) return;
  output_->connected = connected ? 1 : 0;
  report_(connected ? "connected to the fleet" : unreachable);
}

void Publisher::report_standstill() {
  const auto waiting = std::ranges::count_if(valves_, [](const auto& one) { return one.second.waiting() > 0; });
  switch (standstill_.look(waiting > 0, Clock::now())) {
    case Standstill::News::begins:
      standing_ = fmt::format(
          "the fleet has committed nothing for {} s; blocks of {} valves wait and are kept; see `spoolflow fleet "
          "--status` there: it shows whether workers have the partitions, and what the stream holds",
          Standstill::patience.count(), waiting);
      report_(standing_);
      return;
    case Standstill::News::ends:
      standing_.clear();
      report_("the fleet commits blocks again");
      return;
    case Standstill::News::none:
      return;
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
    if (found == valves_.end() || found->second.session() != session) continue;
    if (!found->second.covered(number, Clock::now())) continue;
    ++output_->received;
    engine_.covered(id, number);
    standstill_.committed(Clock::now());
  }
}

void Publisher::answer(const std::string& ask) {
  std::istringstream words(ask);
  std::string what, name;
  std::uint64_t number = 0;
  words >> what >> name >> number;
  if (what == "blocks") {
    const auto found = valves_.find(name);
    if (found != valves_.end()) found->second.asked(number);
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
      report_(
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
  for (auto& [valve, at] : valves_) send(database, valve, at);
}

void Publisher::send(live::Database& database, const std::string& valve, Delivery& at) {
  const Delivery::Due due = at.due(Clock::now());
  if (due.most == 0) return;
  const std::string& site = engine_.site().fleet.site;
  const std::string subject = block_subject(partition_of(fmt::format("{}/{}", site, valve)), site);
  std::uint64_t before = due.after;
  for (live::OutboxBlock& one : live::blocks_of(database, valve, due.after, due.most)) {
    if (one.number != before + 1) {  // those between were given up: this one stands for them
      auto read = read_block(one.bytes);
      if (Block* const block = std::get_if<Block>(&read)) {
        block->first = before + 1;
        one.bytes = write_block(*block);
      }
    }
    if (!nats_.publish(subject, one.bytes)) return;
    at.sent(one.number, Clock::now());
    ++output_->sent;
    before = one.number;
  }
}

}  // namespace spoolflow::fleet
