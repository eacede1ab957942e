#include "addons/live/history/told_table.hpp"

namespace spoolflow::live {

void make_told_table(Database& database) {
  database.run("CREATE TABLE IF NOT EXISTS told(receiver TEXT PRIMARY KEY, alarms TEXT NOT NULL) WITHOUT ROWID");
}

ToldTexts kept_told(Database& database) {
  ToldTexts out;
  Statement each(database, "SELECT receiver, alarms FROM told");
  while (each.next()) out[each.text(0)] = each.text(1);
  return out;
}

void keep_told(Database& database, const ToldTexts& told) {
  if (told.empty()) return;
  Statement one(database, "INSERT OR REPLACE INTO told VALUES(?,?)");
  for (const auto& [receiver, alarms] : told) one.put(std::string_view(receiver)).put(std::string_view(alarms)).run();
}

}  // namespace spoolflow::live
