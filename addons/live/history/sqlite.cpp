#include "addons/live/history/sqlite.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sqlite3.h>
#include <system_error>

#include <fmt/format.h>

namespace spoolflow::live {

void Database::Close::operator()(sqlite3* handle) const {
  sqlite3_close_v2(handle);
}

void Database::refuse(int code) const {
  const char* const said = handle_ ? sqlite3_errmsg(handle_.get()) : sqlite3_errstr(code);
  if (code == SQLITE_IOERR_SHORT_READ) {
    throw StoreDamage(fmt::format("{}: is damaged (it, or the log beside it, has become shorter)", path_));
  }
  switch (code & 0xFF) {
    case SQLITE_FULL:
      throw StoreError(
          fmt::format("{}: the disk is full; free some space, or let the store keep less (keep_days, "
                      "largest_MB)",
                      path_));
    case SQLITE_NOTADB:
      throw StoreDamage(fmt::format("{}: is no store of spoolflow live; name another file", path_));
    case SQLITE_CORRUPT:
      throw StoreDamage(
          fmt::format("{}: is damaged ({}); keep a copy of it, save what can be read with `sqlite3 {} "
                      ".recover`, and name another file",
                      path_, said, path_));
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY:
    case SQLITE_PERM:
      throw StoreError(fmt::format("{}: cannot be opened for this ({}); check the folder and its rights", path_, said));
    case SQLITE_BUSY:
      throw StoreError(fmt::format("{}: is held by another program ({}); end that first", path_, said));
    default:
      throw StoreError(fmt::format("{}: {}; check the disk that it lies on", path_, said));
  }
}

Database::Database(std::string path, Access access) : path_(std::move(path)) {
  sqlite3* opened = nullptr;
  std::error_code unreadable;
  if (std::filesystem::is_directory(path_, unreadable))
    throw StoreError(fmt::format("{}: is a folder; name a store in it", path_));
  const int flags = access == Access::write ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY;
  const int code = sqlite3_open_v2(path_.c_str(), &opened, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  handle_.reset(opened);
  if (code != SQLITE_OK) refuse(code);
  sqlite3_extended_result_codes(opened, 1);
  sqlite3_busy_timeout(opened, 2000);
}

bool Database::begins_as_database() const {
  constexpr std::string_view magic("SQLite format 3\0", 16);
  sqlite3_file* file = nullptr;
  if (sqlite3_file_control(handle_.get(), "main", SQLITE_FCNTL_FILE_POINTER, &file) != SQLITE_OK) return true;
  if (file == nullptr || file->pMethods == nullptr) return true;
  std::array<char, magic.size()> found{};
  const int code = file->pMethods->xRead(file, found.data(), static_cast<int>(found.size()), 0);
  return code == SQLITE_OK && std::string_view(found.data(), found.size()) == magic;
}

void Database::leave_log() {
  sqlite3_db_config(handle_.get(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
}

void Database::run(const std::string& sql) {
  const int code = sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) refuse(code);
}

std::int64_t Database::number(const std::string& sql) {
  Statement statement(*this, sql);
  return statement.next() ? statement.integer(0) : 0;
}

void Statement::Finalize::operator()(sqlite3_stmt* handle) const {
  sqlite3_finalize(handle);
}

Statement::Statement(Database& database, std::string_view sql) : database_(database) {
  sqlite3_stmt* made = nullptr;
  check(sqlite3_prepare_v2(database.handle(), sql.data(), static_cast<int>(sql.size()), &made, nullptr));
  handle_.reset(made);
}

void Statement::check(int code) const {
  if (code != SQLITE_OK) database_.refuse(code);
}

Statement& Statement::put(std::int64_t value) {
  check(sqlite3_bind_int64(handle_.get(), ++bound_, value));
  return *this;
}

Statement& Statement::put(double value) {
  check(std::isnan(value) ? sqlite3_bind_null(handle_.get(), ++bound_)
                          : sqlite3_bind_double(handle_.get(), ++bound_, value));
  return *this;
}

Statement& Statement::put(std::string_view text) {
  check(sqlite3_bind_text64(handle_.get(), ++bound_, text.empty() ? "" : text.data(), text.size(), SQLITE_TRANSIENT,
                            SQLITE_UTF8));
  return *this;
}

Statement& Statement::put(std::span<const std::byte> bytes) {
  const void* const from =
      bytes.empty() ? "" : static_cast<const void*>(bytes.data());  // from nowhere it would be null
  check(sqlite3_bind_blob64(handle_.get(), ++bound_, from, bytes.size(), SQLITE_TRANSIENT));
  return *this;
}

bool Statement::next() {
  bound_ = 0;
  const int code = sqlite3_step(handle_.get());
  if (code == SQLITE_ROW) return true;
  sqlite3_reset(handle_.get());
  if (code != SQLITE_DONE) database_.refuse(code);
  return false;
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(handle_.get(), column);
}

double Statement::real(int column) const {
  if (sqlite3_column_type(handle_.get(), column) == SQLITE_NULL) return std::numeric_limits<double>::quiet_NaN();
  return sqlite3_column_double(handle_.get(), column);
}

std::string Statement::text(int column) const {
  const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), column));
  return text == nullptr ? std::string()
                         : std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column)));
}

std::span<const std::byte> Statement::bytes(int column) const {
  const void* const blob = sqlite3_column_blob(handle_.get(), column);
  const int length = sqlite3_column_bytes(handle_.get(), column);
  return {static_cast<const std::byte*>(blob), blob == nullptr ? 0 : static_cast<std::size_t>(length)};
}

Transaction::~Transaction() {
  if (open_) sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  database_.run("COMMIT");
  open_ = false;
}

}  // namespace spoolflow::live
