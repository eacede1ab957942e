#pragma once
/// What each receiver of messages of alarms was told, so that a new start goes on there. To the store it is a text.
#include <map>
#include <string>

#include "addons/live/history/sqlite.hpp"

namespace spoolflow::live {

/// By the receiver's name.
using ToldTexts = std::map<std::string, std::string>;

/// Where there is none yet; stores of programs that sent no messages get it, too.
void make_told_table(Database& database);
[[nodiscard]] ToldTexts kept_told(Database& database);
/// In the transaction of the caller.
void keep_told(Database& database, const ToldTexts& told);

}  // namespace spoolflow::live
