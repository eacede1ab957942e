#pragma once
/// libpq's handles, closed with their owners, prepared statements alone, and errors as exceptions.
#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

struct pg_conn;
struct pg_result;

namespace spoolflow::fleet {

/// The server cannot be reached, or ended the session: worth another try with another connection.
struct ServerAway : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// What the server refuses: exit status 2 where it is met at the start.
struct ServerRefuses : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// It refuses a statement for what it was given: a text, a number, a row that its tables do not take.
struct ContentRefused : ServerRefuses {
  using ServerRefuses::ServerRefuses;
};

/// The parameters of a statement, in their order.
class Values {
 public:
  Values& put(std::int64_t value);
  Values& put(double value);  ///< to the last digit; NaN is null
  Values& put(std::string_view text);
  Values& put(std::span<const std::uint8_t> bytes);
  Values& put_null();

 private:
  friend class Session;
  std::vector<std::string> texts_;
  std::vector<bool> binary_, null_;
};

/// Rows of a statement.
class Rows {
 public:
  explicit Rows(pg_result* handle) : handle_(handle) {}
  [[nodiscard]] int size() const;
  [[nodiscard]] bool is_null(int row, int column) const;
  [[nodiscard]] std::int64_t integer(int row, int column) const;
  [[nodiscard]] double real(int row, int column) const;  ///< null is NaN
  [[nodiscard]] std::string text(int row, int column) const;
  [[nodiscard]] std::vector<std::uint8_t> bytes(int row, int column) const;
  /// Rows that were inserted, changed or deleted.
  [[nodiscard]] std::int64_t affected() const;

 private:
  friend class Session;
  struct Clear {
    void operator()(pg_result* handle) const;
  };
  std::unique_ptr<pg_result, Clear> handle_;
};

/// One connection; of one thread at a time.
class Session {
 public:
  /// `connection` as libpq reads it: "host=a,b user=worker dbname=fleet target_session_attrs=read-write".
  /// `answers_within`: a server that takes longer for a statement counts as away, though its machine keeps the line
  /// open; 0: statements take as long as they take. Throws ServerAway, or ServerRefuses where another try cannot help.
  Session(const std::string& connection, const std::string& name,
          std::chrono::seconds answers_within = std::chrono::seconds(0));

  /// A statement that was prepared at its first use. Throws ServerAway, or ServerRefuses (ContentRefused).
  Rows run(const char* sql, const Values& values = {});
  /// Statements of the program itself, without parameters or rows: of the schema.
  void run_script(const std::string& sql);

 private:
  struct Finish {
    void operator()(pg_conn* handle) const;
  };
  Rows answer(int was_sent, const char* sql);
  void wait_for_server(bool to_write, std::chrono::steady_clock::time_point since);
  void check(pg_result* result, const char* sql);
  std::unique_ptr<pg_conn, Finish> handle_;
  std::chrono::seconds answers_within_;
  std::unordered_map<const char*, std::string> prepared_;  ///< names by the statements' places
};

/// A transaction that is taken back unless it is committed.
class FleetTransaction {
 public:
  explicit FleetTransaction(Session& session);
  ~FleetTransaction();
  FleetTransaction(const FleetTransaction&) = delete;
  FleetTransaction& operator=(const FleetTransaction&) = delete;
  void commit();

 private:
  Session& session_;
  bool open_ = true;
};

}  // namespace spoolflow::fleet
