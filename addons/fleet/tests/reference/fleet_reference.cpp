/// fleet_reference VERSION STORE.sqlite MODEL.json RAISED_AFTER_S GONE_AFTER_S: what the fleet must keep of the blocks
/// in a site's store, computed by one process without servers, one line a row, numbers as their bits. The driver
/// compares it with the rows in PostgreSQL.
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "addons/fleet/models.hpp"
#include "addons/fleet/valve_line.hpp"
#include "spoolflow/model/provenance.hpp"

namespace {

using namespace spoolflow;

std::string bits(double value) {
  return std::isnan(value) ? "" : fmt::format("\\x{:016x}", std::bit_cast<std::uint64_t>(value));
}

void print_rows(const std::string& valve, const fleet::ValveRows& rows) {
  for (const auto& [block, wall_ms, of] : rows.seconds) {
    fmt::print("second|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}\n", valve, block.session, block.number, wall_ms,
               bits(of.time_s), of.samples, bits(of.flow_min_m3_per_s), bits(of.flow_mean_m3_per_s),
               bits(of.flow_max_m3_per_s), bits(of.lower_min_m3_per_s), bits(of.upper_max_m3_per_s), bits(of.energy_J),
               of.status);
  }
  for (const auto& [block, wall_ms, of] : rows.indicators) {
    fmt::print("indicator|{}|{}|{}|{}|{}|{}|{}|{}|{}\n", valve, block.session, block.number, wall_ms, of.name,
               bits(of.value), bits(of.uncertainty_95), bits(of.baseline), of.state);
  }
  for (const live::Event& one : rows.events) {
    fmt::print("event|{}|{}|{}|{}|{}\n", valve, one.wall_ms, bits(one.time_s), one.kind, one.text);
  }
  for (const auto& [from, sha256] : rows.models) {
    fmt::print("model_in_force|{}|{}|{}|{}\n", valve, from.session, from.number, sha256);
  }
}

void print_end(const std::string& valve, const fleet::ValvePosition& at,
               const std::map<std::int64_t, live::Alarm>& alarms) {
  fmt::print("coverage|{}|{}|{}|{}|{}|{}\n", valve, at.block.session, at.block.number, at.wall_ms, at.minute,
             at.model_sha256);
  fmt::print("state|{}|{}|{}|{}\n", valve, at.state.next, at.state.samples, bits(at.state.energy_J));
  for (const auto& [id, alarm] : alarms) {
    fmt::print("alarm|{}|{}|{}|{}|{}|{}|{}|{}|{}\n", valve, id, alarm.cause, alarm.sign, alarm.raised_ms, alarm.gone_ms,
               alarm.times, bits(alarm.time_s), alarm.text);
  }
}

void compute(char** arguments) {
  std::ifstream in(arguments[3], std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  fleet::Models models;
  const auto model = models.add(model::sha256_of_text(text), fleet::pack_model(text));
  const live::AlarmDelays delays{std::strtod(arguments[4], nullptr), std::strtod(arguments[5], nullptr)};
  live::Database store = live::open_store_to_read(arguments[2]);
  for (const live::OutboxPosition& position : live::outbox_positions(store)) {
    std::unique_ptr<fleet::ValveLine> line;
    std::string valve;
    std::map<std::int64_t, live::Alarm> alarms;
    fleet::ValvePosition end;
    for (const live::OutboxBlock& one : live::blocks_of(store, position.valve, 0, position.number)) {
      const fleet::Block block = std::get<fleet::Block>(fleet::read_block(one.bytes));
      valve = block.valve;
      if (!line) line = std::make_unique<fleet::ValveLine>(valve, arguments[1], delays);
      if (line->turn(block) != fleet::ValveLine::Turn::next) std::abort();
      line->work(block, *model);
      auto rows = line->take_rows();
      print_rows(valve, *rows);
      for (const live::Alarm& alarm : rows->alarms) {
        if (!alarms.try_emplace(alarm.id, alarm).second) alarms[alarm.id] = alarm;
      }
      end = rows->position;
    }
    print_end(valve, end, alarms);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) return 2;
  try {
    compute(argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fleet_reference: %s\n", error.what());
    return 1;
  }
}
