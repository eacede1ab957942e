#pragma once
/// A store's file before it is used: its tables, and whether this program may use it.
#include "addons/live/history/sqlite.hpp"

namespace spoolflow::live {

/// Grows with the tables. Files of version 2 are read as they are and, where a program works on them, made into ones of
/// this version in place; others are refused.
inline constexpr int store_version = 3, oldest_store_version = 2;

/// Throws StoreError where the file is of another program or version.
void check_version(Database& database);

/// Makes the tables where there are none or older ones, checks version and, unless it is large, content. Throws
/// StoreError.
void prepare(Database& database);

}  // namespace spoolflow::live
