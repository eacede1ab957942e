#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/recording/channels/allowed_names.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/toml_input.hpp"
#include "spoolflow/validation/requirements.hpp"

namespace spoolflow::validation {
namespace {

using recording::RecordingError;
using recording::TomlTable;

constexpr std::array estimator_names{Named<estimation::Estimator>{estimation::Estimator::condensed, "condensed"},
                                     Named<estimation::Estimator>{estimation::Estimator::observer, "observer"}};

/// The value of a key that holds one of some names.
template <class Value, std::size_t count>
std::optional<Value> one_of(const TomlTable& table, std::string_view key,
                            const std::array<Named<Value>, count>& names) {
  std::array<std::string_view, count> allowed;
  std::ranges::transform(names, allowed.begin(), &Named<Value>::name);
  const std::optional<std::size_t> chosen = table.optional_choice(key, allowed);
  return chosen ? std::optional(names[*chosen].value) : std::nullopt;
}

bool is_share(Figure figure) {
  return figure == Figure::band_coverage || figure == Figure::p95_of_reading || figure == Figure::fault_share ||
         figure == Figure::wrong_sign;
}

void check_unit(const Limit& limit, const TomlTable& table) {
  const bool share = is_share(limit.figure);
  if (share == (limit.unit == LimitUnit::percent)) return;
  throw RecordingError(fmt::format("{}: {} has no unit \"{}\"; write unit = {}", table.place("unit"),
                                   name_of(figure_names, limit.figure), name_of(limit_unit_names, limit.unit),
                                   share ? "\"%\"" : "\"% FS\" or \"L/min\""));
}

void check_bounds(const Limit& limit, const TomlTable& table) {
  if (!limit.at_least && !limit.at_most) {
    throw RecordingError(
        fmt::format("{}: {} bounds nothing; give it at_most, at_least or both", limit.place, table.name));
  }
  const bool share_of_samples = is_share(limit.figure) && limit.figure != Figure::p95_of_reading;
  for (const auto& [key, bound] : {std::pair{"at_least", limit.at_least}, std::pair{"at_most", limit.at_most}}) {
    if (!bound) continue;
    if (*bound < 0 || (share_of_samples && *bound > 100)) {
      throw RecordingError(fmt::format("{}: '{}' in {} is {}; {} lies {}", table.place(key), key, table.name, *bound,
                                       name_of(figure_names, limit.figure),
                                       share_of_samples ? "between 0 and 100 %" : "at or above zero"));
    }
  }
  if (share_of_samples && limit.at_least && *limit.at_least > 0 && *limit.at_least <= 1) {
    throw RecordingError(fmt::format("{}: 'at_least' in {} is {} %, which says nothing of {}; write 95 for 95 %",
                                     table.place("at_least"), table.name, *limit.at_least,
                                     name_of(figure_names, limit.figure)));
  }
  if (limit.at_least && limit.at_most && *limit.at_least > *limit.at_most) {
    throw RecordingError(fmt::format("{}: at_least = {} is above at_most = {}; nothing can meet that",
                                     table.place("at_least"), *limit.at_least, *limit.at_most));
  }
}

Limit read_limit(const TomlTable& table) {
  table.allow_only({"figure", "at_most", "at_least", "unit", "run", "when", "estimator"});
  Limit limit;
  limit.place = recording::place_of(table.table, table.file);
  (void)table.text("figure");
  limit.figure = one_of(table, "figure", figure_names).value_or(Figure::p95);
  limit.run = table.optional_text("run").value_or("all");
  limit.when = one_of(table, "when", when_names).value_or(When::always);
  limit.estimator = one_of(table, "estimator", estimator_names);
  limit.unit = one_of(table, "unit", limit_unit_names)
                   .value_or(is_share(limit.figure) ? LimitUnit::percent : LimitUnit::percent_FS);
  limit.at_least = table.optional_number("at_least");
  limit.at_most = table.optional_number("at_most");
  check_unit(limit, table);
  check_bounds(limit, table);
  const bool of_all_samples = is_share(limit.figure) && limit.figure != Figure::band_coverage;
  if (of_all_samples && limit.when != When::always) {
    throw RecordingError(fmt::format("{}: {} is of all samples only; leave 'when' out", table.place("when"),
                                     name_of(figure_names, limit.figure)));
  }
  return limit;
}

}  // namespace

Requirements read_requirements(const std::filesystem::path& file) {
  const toml::table document = recording::read_toml(file);
  const TomlTable whole{document, file, "the file"};
  whole.allow_only({"limit"});
  Requirements out{file.filename().string(), {}};
  for (TomlTable& entry : whole.tables("limit",
                                       "holds no limit; write [[limit]] with figure = \"p95\" and at_most = 5, "
                                       "and so on (docs/formats/requirements.md)")) {
    entry.name = fmt::format("limit {}", out.limits.size() + 1);
    out.limits.push_back(read_limit(entry));
  }
  return out;
}

void check_names(const Requirements& requirements, const std::vector<std::string>& runs,
                 const std::vector<estimation::Estimator>& estimators) {
  for (const Limit& limit : requirements.limits) {
    std::vector<std::string> allowed{"all", "each"};
    allowed.insert(allowed.end(), runs.begin(), runs.end());
    if (std::ranges::find(allowed, limit.run) == allowed.end()) {
      throw RecordingError(fmt::format("{}: run = \"{}\" is none of the recordings{}; allowed: {}", limit.place,
                                       limit.run, recording::did_you_mean(limit.run, allowed),
                                       recording::listed(allowed)));
    }
    if (limit.estimator && std::ranges::find(estimators, *limit.estimator) == estimators.end()) {
      throw RecordingError(
          fmt::format("{}: estimator = \"{}\" is not run here; choose it with --estimator, or leave the "
                      "limit's estimator out",
                      limit.place, name(*limit.estimator)));
    }
  }
}

}  // namespace spoolflow::validation
