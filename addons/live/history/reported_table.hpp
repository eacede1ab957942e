#pragma once
/// The alarms that each receiver of messages has, so that a new start goes on there. To the store it is a text.
#include <map>
#include <string>

#include "addons/live/history/sqlite.hpp"

namespace spoolflow::live {

/// By the receiver's name.
using ReportedTexts = std::map<std::string, std::string>;

/// Where there is none yet; stores of programs that sent no messages get it, too.
void make_reported_table(Database& database);
[[nodiscard]] ReportedTexts kept_reports(Database& database);
/// In the transaction of the caller.
void keep_reports(Database& database, const ReportedTexts& reported);

}  // namespace spoolflow::live
