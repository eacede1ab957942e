#include "addons/fleet/set_aside.hpp"

#include <utility>

#include <fmt/format.h>

namespace spoolflow::fleet {
namespace {

constexpr std::size_t longest_shown = 200, most_lines = 8;

/// The sender chooses the bytes: neither a terminal nor a database takes all of them.
std::string printable(std::string_view text) {
  std::string out(text.substr(0, longest_shown));
  for (char& c : out) {
    if (c < ' ' || c > '~') c = '?';
  }
  return out;
}

}  // namespace

void SetAside::add(const Message& message, const Block* header, std::string_view reason) {
  ++waiting_.count;
  if (waiting_.kept.size() == SetAsideBlocks::most_kept) return;
  SetAsideBlock one{.subject = printable(message.subject), .sequence = message.sequence};
  if (header != nullptr) {
    one.valve = header->valve;
    one.block = {header->session, header->number};
  }
  one.reason = reason;
  one.bytes = message.bytes;
  waiting_.kept.push_back(std::move(one));
}

void SetAside::add(const Block& block, const std::string& subject, std::string_view reason) {
  const std::vector<std::uint8_t> bytes = write_block(block);
  add({.subject = subject, .bytes = std::string(bytes.begin(), bytes.end())}, &block, reason);
}

std::vector<std::string> SetAside::committed(std::int64_t partition, const std::vector<std::size_t>& first_seen) {
  std::vector<std::string> lines;
  for (const std::size_t k : first_seen) {
    const SetAsideBlock& one = waiting_.kept[k];
    if (lines.size() == most_lines) {
      lines.push_back(fmt::format("partition {}: {} blocks more are set aside", partition, first_seen.size() - k));
      break;
    }
    const std::string whose =
        one.valve.empty() ? "no known valve" : fmt::format("{}, number {}", one.valve, one.block.number);
    lines.push_back(fmt::format(
        "partition {}: a block of {} (subject {}, stream sequence {}) is set aside: it is {}; see the table set_aside",
        partition, whose, one.subject, one.sequence, one.reason));
  }
  waiting_ = {};
  return lines;
}

}  // namespace spoolflow::fleet
