#pragma once
/// Columns of one name distinguished, so that a channel map can name each.
#include <map>
#include <set>
#include <string>
#include <vector>

#include "spoolflow/recording/files/sample_table.hpp"

namespace spoolflow::recording {

/// "I [A]" twice becomes "I [A] #1" and "I [A] #2"; the leaf, by which a channel is known, stays.
inline void number_equal_names(std::vector<FileColumn>& columns) {
  std::map<std::string, std::size_t> count, given;
  std::set<std::string> taken;
  for (const FileColumn& column : columns) ++count[column.name];
  for (const auto& [name, of_it] : count) {
    if (of_it == 1) taken.insert(name);
  }
  for (FileColumn& column : columns) {
    if (column.name.empty() || count[column.name] == 1) continue;
    std::size_t& number = given[column.name];
    std::string numbered;
    do numbered = column.name + " #" + std::to_string(++number);
    while (!taken.insert(numbered).second);
    column.name = std::move(numbered);
  }
}

}  // namespace spoolflow::recording
