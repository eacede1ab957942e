#pragma once
/// SQLite's handles, closed with their owners, and its errors as exceptions.
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace spoolflow::live {

/// A store that cannot be used: exit status 2 where it is met at the start.
struct StoreError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// One that was sound: what SQLite reads is none of what it wrote.
struct StoreDamage : StoreError {
  using StoreError::StoreError;
};

class Statement;

class Database {
 public:
  enum class Access : std::uint8_t { read, write };
  /// Throws StoreError in words that say what to do: no permission, damaged, no database at all.
  Database(std::string path, Access access);

  /// One or several statements without results.
  void run(const std::string& sql);
  /// The single number that a statement gives.
  [[nodiscard]] std::int64_t number(const std::string& sql);
  [[nodiscard]] sqlite3* handle() const { return handle_.get(); }
  [[nodiscard]] const std::string& path() const { return path_; }
  [[noreturn]] void refuse(int code) const;
  /// The file, not what the log beside it will make of it.
  [[nodiscard]] bool begins_as_database() const;
  /// Its end leaves the log beside the file as it is, and the file alone.
  void leave_log();

 private:
  struct Close {
    void operator()(sqlite3* handle) const;
  };
  std::string path_;
  std::unique_ptr<sqlite3, Close> handle_;
};

/// A prepared statement; parameters count from 1 and are bound in their order by put().
class Statement {
 public:
  Statement(Database& database, std::string_view sql);

  Statement& put(std::int64_t value);
  Statement& put(double value);  ///< NaN is null
  Statement& put(std::string_view text);
  Statement& put(std::span<const std::byte> bytes);
  /// To the next row; false behind the last, and then the statement may be filled again.
  bool next();
  /// Where no rows are expected.
  void run() {
    while (next()) {
    }
  }

  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] double real(int column) const;  ///< null is NaN
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] std::span<const std::byte> bytes(int column) const;  ///< until the next call of next()

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* handle) const;
  };
  void check(int code) const;
  Database& database_;
  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
  int bound_ = 0;
};

/// A transaction that is taken back unless it is committed.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(database) { database_.run("BEGIN IMMEDIATE"); }
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace spoolflow::live
