#include "spoolflow/recording/files/file_contents.hpp"

#include <utility>

#include "spoolflow/recording/files/header_name.hpp"

namespace spoolflow::recording {

std::vector<std::string> FileContents::names() const {
  std::vector<std::string> out;
  for (const FileColumn& column : columns) out.push_back(column.name);
  return out;
}

FileContents contents_of(std::string format, const SampleTable& table) {
  FileContents out{std::move(format), {}, {}};
  for (const FileColumn& column : table.columns())
    out.columns.push_back({column.name, column.leaf, stated_unit(column)});
  if (const std::string lost = table.lost(); !lost.empty()) out.unread.push_back(lost);
  for (const UnreadPart& part : table.unread()) out.unread.push_back(part.what);
  return out;
}

}  // namespace spoolflow::recording
