#include "addons/live/history/reported_table.hpp"

namespace spoolflow::live {

void make_reported_table(Database& database) {
  database.run("CREATE TABLE IF NOT EXISTS reported(receiver TEXT PRIMARY KEY, alarms TEXT NOT NULL) WITHOUT ROWID");
}

ReportedTexts kept_reports(Database& database) {
  ReportedTexts out;
  Statement each(database, "SELECT receiver, alarms FROM reported");
  while (each.next()) out[each.text(0)] = each.text(1);
  return out;
}

void keep_reports(Database& database, const ReportedTexts& reported) {
  if (reported.empty()) return;
  Statement one(database, "INSERT OR REPLACE INTO reported VALUES(?,?)");
  for (const auto& [receiver, alarms] : reported)
    one.put(std::string_view(receiver)).put(std::string_view(alarms)).run();
}

}  // namespace spoolflow::live
