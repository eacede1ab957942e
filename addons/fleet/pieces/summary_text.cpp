#include "addons/fleet/pieces/summary_text.hpp"

#include <bit>
#include <cstdint>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "addons/fleet/jobs/piece.hpp"

namespace spoolflow::apps {
namespace {

/// Everything of a summary, once for both ways.
template <class Summary, class Visit>
void for_each_member(Summary& summary, Visit&& visit) {
  visit("file", summary.file);
  visit("samples", summary.samples);
  visit("flow_sum_m3_per_s", summary.flow_sum_m3_per_s);
  visit("width_sum_m3_per_s", summary.width_sum_m3_per_s);
  visit("with_status", summary.with_status);
  visit("with_fault", summary.with_fault);
  visit("rows", summary.notes.rows);
  visit("duplicate_times", summary.notes.duplicate_times);
  visit("missing", summary.notes.missing);
  visit("missing_times", summary.notes.missing_times);
  visit("backward_times", summary.notes.backward_times);
  visit("left_out", summary.notes.left_out);
  visit("doubts", summary.doubts);
}

}  // namespace

std::string text_of(const validation::EstimateSummary& summary) {
  nlohmann::json out;
  for_each_member(summary, [&](const char* name, const auto& member) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(member)>, double>) {
      out[name] = std::bit_cast<std::uint64_t>(member);  // JSON has no NaN
    } else {
      out[name] = member;
    }
  });
  return out.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

validation::EstimateSummary read_summary(const std::string& text) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    validation::EstimateSummary out;
    for_each_member(out, [&](const char* name, auto& member) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(member)>, double>) {
        member = std::bit_cast<double>(json.at(name).get<std::uint64_t>());
      } else {
        json.at(name).get_to(member);
      }
    });
    return out;
  } catch (const nlohmann::json::exception&) {
    throw fleet::PieceError("the summary of an estimate is none that this program has written");
  }
}

}  // namespace spoolflow::apps
