#include "addons/fleet/store/partition_store.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "addons/live/history/state_change.hpp"

namespace spoolflow::fleet {
namespace {

std::span<const std::uint8_t> as_numbers(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}
std::span<const std::byte> as_bytes(const std::vector<std::uint8_t>& numbers) {
  return std::as_bytes(std::span(numbers));
}
std::int64_t sql(std::uint64_t number) {
  return static_cast<std::int64_t>(number);
}
/// A state of more bytes is none that a valve has.
constexpr std::int64_t largest_state = 16 << 20;
/// Of each partition, of at most a megabyte each: the newest.
constexpr std::int64_t most_set_aside = 100;

}  // namespace

std::vector<KeptValve> PartitionStore::read() {
  const Rows rows = session_.run(
      "SELECT valve.number, id, coverage.session, block, wall_ms, minute, model, alarm_waits, next, samples, energy_J, "
      "layout, bytes, content, change FROM valve JOIN coverage ON coverage.valve = valve.number "
      "JOIN state ON state.valve = valve.number JOIN older_state ON older_state.valve = valve.number "
      "WHERE partition = $1 ORDER BY id",
      Values().put(claim_.partition));
  states_.clear();
  std::vector<KeptValve> out;
  for (int row = 0; row < rows.size(); ++row) {
    KeptValve kept;
    ValvePosition& at = kept.position;
    at.block = {static_cast<std::uint64_t>(rows.integer(row, 2)), static_cast<std::uint64_t>(rows.integer(row, 3))};
    at.wall_ms = rows.integer(row, 4);
    at.minute = rows.integer(row, 5);
    at.model_sha256 = rows.text(row, 6);
    at.alarm_waits = rows.text(row, 7);
    at.state = {.valve = rows.text(row, 1),
                .session = at.block.session,
                .next = static_cast<std::uint64_t>(rows.integer(row, 8)),
                .samples = static_cast<std::uint64_t>(rows.integer(row, 9)),
                .energy_J = rows.real(row, 10),
                .layout = rows.text(row, 11)};
    OlderState& older = states_[at.state.valve];
    older = {.number = rows.integer(row, 0), .layout = at.state.layout};
    const std::int64_t length = rows.integer(row, 12);
    const std::vector<std::uint8_t> content = rows.bytes(row, 13), change = rows.bytes(row, 14);
    bool whole = length >= 0 && length <= largest_state;
    if (whole) {
      older.bytes.resize(static_cast<std::size_t>(length));
      whole = live::apply_change(as_bytes(content), older.bytes);
      at.state.bytes = older.bytes;
      whole = whole && live::apply_change(as_bytes(change), at.state.bytes);
      older.written = content.size() + 1;
    }
    if (!whole) throw ServerRefuses(fmt::format("the kept state of {} is damaged; restore a backup", at.state.valve));
    kept.alarms = alarms_of(at.state.valve);
    out.push_back(std::move(kept));
  }
  return out;
}

std::vector<live::Alarm> PartitionStore::alarms_of(const std::string& valve) {
  const Rows rows = session_.run(
      "SELECT id, cause, sign, raised_ms, gone_ms, acknowledged_ms, acknowledged_by, times, time_s, text, recording "
      "FROM alarm WHERE valve = $1 AND (gone_ms = 0 OR acknowledged_ms = 0 OR id = (SELECT max(id) FROM alarm WHERE "
      "valve = $1)) ORDER BY id",
      Values().put(std::string_view(valve)));
  std::vector<live::Alarm> out;
  for (int row = 0; row < rows.size(); ++row) {
    live::Alarm alarm{.id = rows.integer(row, 0), .valve = valve};
    alarm.cause = rows.text(row, 1);
    alarm.sign = rows.text(row, 2);
    alarm.raised_ms = rows.integer(row, 3);
    alarm.gone_ms = rows.integer(row, 4);
    alarm.acknowledged_ms = rows.integer(row, 5);
    alarm.acknowledged_by = rows.text(row, 6);
    alarm.times = rows.integer(row, 7);
    alarm.time_s = rows.real(row, 8);
    alarm.text = rows.text(row, 9);
    alarm.recording = rows.integer(row, 10);
    out.push_back(std::move(alarm));
  }
  return out;
}

StreamPosition PartitionStore::stream_position() {
  const Rows row = session_.run("SELECT stream_created, stream_sequence FROM partition WHERE number = $1",
                                Values().put(claim_.partition));
  if (row.size() == 0) throw ServerRefuses(fmt::format("there is no partition {}", claim_.partition));
  return {row.integer(0, 0), static_cast<std::uint64_t>(row.integer(0, 1))};
}

PartitionStore::OlderState& PartitionStore::known(const std::string& valve) {
  OlderState& state = states_[valve];
  if (state.number != 0) return state;
  const Values name = Values().put(std::string_view(valve)).put(claim_.partition);
  session_.run("INSERT INTO valve(id, partition) VALUES($1, $2) ON CONFLICT(id) DO NOTHING", name);
  state.number =
      session_.run("SELECT number FROM valve WHERE id = $1", Values().put(std::string_view(valve))).integer(0, 0);
  return state;
}

std::vector<Acknowledgement> PartitionStore::acknowledgements() {
  const Rows rows = session_.run(
      "SELECT acknowledgement.valve, alarm, wall_ms, name FROM acknowledgement JOIN valve ON id = "
      "acknowledgement.valve "
      "WHERE taken_block IS NULL AND partition = $1 ORDER BY acknowledgement.valve, alarm",
      Values().put(claim_.partition));
  std::vector<Acknowledgement> out;
  for (int row = 0; row < rows.size(); ++row)
    out.push_back({rows.text(row, 0), rows.integer(row, 1), rows.integer(row, 2), rows.text(row, 3)});
  return out;
}

std::vector<std::size_t> PartitionStore::commit(const std::vector<ValveRows>& valves,
                                                const std::vector<Acknowledgement>& taken, const SetAsideBlocks& aside,
                                                const StreamPosition& stream) {
  FleetTransaction whole(session_);
  // First of all, and with it the row is this transaction's: nobody takes the partition before it has ended.
  const Rows mine = session_.run(
      "UPDATE partition SET stream_created = $3, stream_sequence = $4, lease_until = greatest(lease_until, "
      "clock_timestamp() + $5::float8 * interval '1 s') WHERE number = $1 AND epoch = $2",
      Values().put(claim_.partition).put(claim_.epoch).put(stream.created_ns).put(sql(stream.sequence)).put(lease_s_));
  if (mine.affected() != 1) {
    throw Fenced(fmt::format("partition {} was taken by another worker", claim_.partition));
  }
  for (const ValveRows& valve : valves) {
    try {
      OlderState& older = known(valve.position.state.valve);
      put_rows(older.number, valve);
      put_state(older, valve.position.state);
      put_position(older.number, valve.position);
    } catch (const ContentRefused& error) {
      throw ValveRefused(valve.position.state.valve, error.what());
    }
  }
  for (const Acknowledgement& one : taken) {
    session_.run("UPDATE acknowledgement SET taken_session = $3, taken_block = $4 WHERE valve = $1 AND alarm = $2",
                 Values()
                     .put(std::string_view(one.valve))
                     .put(one.alarm)
                     .put(sql(one.taken.session))
                     .put(sql(one.taken.number)));
  }
  std::vector<std::size_t> first_seen = put_aside(aside);
  whole.commit();
  return first_seen;
}

/// A site sends a block again until it is covered: the same bytes are one row.
std::vector<std::size_t> PartitionStore::put_aside(const SetAsideBlocks& aside) {
  std::vector<std::size_t> first_seen;
  if (aside.count == 0) return first_seen;
  for (std::size_t k = 0; k < aside.kept.size(); ++k) {
    const SetAsideBlock& one = aside.kept[k];
    Values values;
    values.put(claim_.partition).put(sql(one.sequence)).put(std::string_view(one.subject));
    values.put(std::string_view(one.valve)).put(sql(one.block.session)).put(sql(one.block.number));
    values.put(std::string_view(one.reason));
    values.put(std::span(reinterpret_cast<const std::uint8_t*>(one.bytes.data()), one.bytes.size()));
    const Rows row = session_.run(
        "INSERT INTO set_aside(partition, sequence, subject, valve, session, block, reason, content, digest) "
        "VALUES($1, "
        "$2, $3, $4, $5, $6, $7, $8, sha256($8)) ON CONFLICT(partition, digest) DO UPDATE SET times = set_aside.times "
        "+ "
        "1, came_last = now(), sequence = excluded.sequence, reason = excluded.reason RETURNING times",
        values);
    if (row.integer(0, 0) == 1) first_seen.push_back(k);
  }
  session_.run("UPDATE partition SET set_aside = set_aside + $2 WHERE number = $1",
               Values().put(claim_.partition).put(aside.count));
  session_.run(
      "DELETE FROM set_aside WHERE partition = $1 AND number < (SELECT min(number) FROM (SELECT number FROM set_aside "
      "WHERE partition = $1 ORDER BY number DESC LIMIT $2) newest)",
      Values().put(claim_.partition).put(most_set_aside));
  return first_seen;
}

void PartitionStore::put_rows(std::int64_t number, const ValveRows& valve) {
  for (const ModelChange& one : valve.models) {
    session_.run(
        "INSERT INTO model_in_force VALUES($1, $2, $3, $4)",
        Values().put(number).put(sql(one.from.session)).put(sql(one.from.number)).put(std::string_view(one.sha256)));
  }
  for (const SecondRow& one : valve.seconds) {
    const live::Summary& of = one.summary;
    Values values;
    values.put(number).put(sql(one.block.session)).put(sql(one.block.number)).put(one.wall_ms).put(of.time_s);
    values.put(of.samples).put(of.flow_min_m3_per_s).put(of.flow_mean_m3_per_s).put(of.flow_max_m3_per_s);
    values.put(of.lower_min_m3_per_s).put(of.upper_max_m3_per_s).put(of.energy_J).put(std::int64_t{of.status});
    session_.run("INSERT INTO second VALUES($1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11, $12, $13)", values);
  }
  for (const IndicatorRow& one : valve.indicators) {
    Values values;
    values.put(number).put(sql(one.block.session)).put(sql(one.block.number)).put(one.wall_ms);
    values.put(std::string_view(one.indicator.name)).put(one.indicator.value).put(one.indicator.uncertainty_95);
    values.put(one.indicator.baseline).put(std::string_view(one.indicator.state));
    values.put(std::string_view(one.indicator.unit));
    session_.run("INSERT INTO indicator VALUES($1, $2, $3, $4, $5, $6, $7, $8, $9, $10) ON CONFLICT DO NOTHING",
                 values);
  }
  for (const live::Event& one : valve.events) {
    session_.run("INSERT INTO event(wall_ms, valve, time_s, kind, text) VALUES($1, $2, $3, $4, $5)",
                 Values()
                     .put(one.wall_ms)
                     .put(std::string_view(one.valve))
                     .put(one.time_s)
                     .put(std::string_view(one.kind))
                     .put(std::string_view(one.text)));
  }
  for (const live::Alarm& one : valve.alarms) put_alarm(one);
}

void PartitionStore::put_alarm(const live::Alarm& one) {
  Values values;
  values.put(std::string_view(one.valve)).put(one.id).put(std::string_view(one.cause)).put(std::string_view(one.sign));
  values.put(one.raised_ms).put(one.gone_ms).put(one.acknowledged_ms).put(std::string_view(one.acknowledged_by));
  values.put(one.times).put(one.time_s).put(std::string_view(one.text)).put(one.recording);
  session_.run(
      "INSERT INTO alarm VALUES($1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11, $12) ON CONFLICT(valve, id) DO UPDATE "
      "SET "
      "sign = excluded.sign, gone_ms = excluded.gone_ms, acknowledged_ms = excluded.acknowledged_ms, "
      "acknowledged_by = excluded.acknowledged_by, times = excluded.times",
      values);
  for (std::size_t k = 0; k < one.indicators.size(); ++k) {
    const live::KeptIndicator& then = one.indicators[k];
    Values row;
    row.put(std::string_view(one.valve)).put(one.id).put(static_cast<std::int64_t>(k)).put(std::string_view(then.name));
    row.put(then.value).put(then.uncertainty_95).put(then.baseline).put(std::string_view(then.state));
    row.put(std::string_view(then.unit));
    session_.run("INSERT INTO alarm_indicator VALUES($1, $2, $3, $4, $5, $6, $7, $8, $9) ON CONFLICT DO NOTHING", row);
  }
}

void PartitionStore::put_state(OlderState& older, const live::KeptState& state) {
  std::vector<std::byte> change;
  const bool comparable = older.written > 0 && older.layout == state.layout && older.bytes.size() == state.bytes.size();
  if (comparable) {
    change = live::state_change(older.bytes, state.bytes);
    older.least = older.least == 0 ? change.size() : std::min(older.least, change.size());
    older.wasted += change.size() - older.least;
  }
  if (!comparable || older.wasted > older.written) {
    const std::vector<std::byte> content = live::state_change({}, state.bytes);
    older = {.number = older.number, .layout = state.layout, .bytes = state.bytes, .written = content.size() + 1};
    change.clear();
    session_.run(
        "INSERT INTO older_state VALUES($1, $2, $3, $4) ON CONFLICT(valve) DO UPDATE SET layout = excluded.layout, "
        "bytes = excluded.bytes, content = excluded.content",
        Values()
            .put(older.number)
            .put(std::string_view(state.layout))
            .put(sql(state.bytes.size()))
            .put(as_numbers(content)));
  }
  session_.run(
      "INSERT INTO state VALUES($1, $2, $3, $4, $5, $6) ON CONFLICT(valve) DO UPDATE SET session = excluded.session, "
      "next = excluded.next, samples = excluded.samples, energy_J = excluded.energy_J, change = excluded.change",
      Values()
          .put(older.number)
          .put(sql(state.session))
          .put(sql(state.next))
          .put(sql(state.samples))
          .put(state.energy_J)
          .put(as_numbers(change)));
}

void PartitionStore::put_position(std::int64_t number, const ValvePosition& at) {
  session_.run(
      "INSERT INTO coverage VALUES($1, $2, $3, $4, $5, $6, $7) ON CONFLICT(valve) DO UPDATE SET session = "
      "excluded.session, block = excluded.block, wall_ms = excluded.wall_ms, minute = excluded.minute, model = "
      "excluded.model, alarm_waits = excluded.alarm_waits, committed = now()",
      Values()
          .put(number)
          .put(sql(at.block.session))
          .put(sql(at.block.number))
          .put(at.wall_ms)
          .put(at.minute)
          .put(std::string_view(at.model_sha256))
          .put(std::string_view(at.alarm_waits)));
}

std::optional<std::vector<std::uint8_t>> PartitionStore::model(const std::string& sha256) {
  const Rows row = session_.run("SELECT content FROM model WHERE sha256 = $1", Values().put(std::string_view(sha256)));
  if (row.size() == 0) return std::nullopt;
  return row.bytes(0, 0);
}

void PartitionStore::keep_model(const std::string& sha256, std::span<const std::uint8_t> content) {
  session_.run("INSERT INTO model(sha256, content) VALUES($1, $2) ON CONFLICT DO NOTHING",
               Values().put(std::string_view(sha256)).put(content));
}

}  // namespace spoolflow::fleet
