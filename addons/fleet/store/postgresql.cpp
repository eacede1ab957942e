#include "addons/fleet/store/postgresql.hpp"

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <libpq-fe.h>
#include <limits>
#include <poll.h>

#include <fmt/format.h>

namespace spoolflow::fleet {
namespace {

/// On one line, without the prefix of libpq.
std::string said(const char* message) {
  std::string out = message == nullptr ? "" : message;
  for (char& c : out) {
    if (c == '\n' || c == '\t') c = ' ';
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

/// What another try with another connection does not help, on the side of this program.
bool is_own_refusal(std::string_view why) {
  for (const char* text : {"certificate", "server does not support SSL", "no password supplied"}) {
    if (why.find(text) != std::string_view::npos) return true;
  }
  return false;
}

/// Whether a server refuses login or database, by the codes that libpq writes into its message where it was asked
/// to before it connects: 28… who one is, 3D000 no such database, 42501 no right to connect.
bool servers_refuse(const std::string& connection) {
  struct Finish {
    void operator()(pg_conn* handle) const { PQfinish(handle); }
  };
  const std::unique_ptr<pg_conn, Finish> handle(PQconnectStart(connection.c_str()));
  if (!handle) return false;
  (void)PQsetErrorVerbosity(handle.get(), PQERRORS_VERBOSE);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(3);
  PostgresPollingStatusType status = PGRES_POLLING_WRITING;
  while (status != PGRES_POLLING_OK && status != PGRES_POLLING_FAILED && std::chrono::steady_clock::now() < end) {
    constexpr int step_ms = 100;
    pollfd socket{PQsocket(handle.get()), static_cast<short>(status == PGRES_POLLING_READING ? POLLIN : POLLOUT), 0};
    if (::poll(&socket, 1, step_ms) > 0) status = PQconnectPoll(handle.get());
  }
  const std::string_view why = PQerrorMessage(handle.get());
  for (const char* code : {" 28", " 3D000:", " 42501:"}) {
    if (why.find(std::string("FATAL: ") + code) != std::string_view::npos) return true;
  }
  return false;
}

}  // namespace

Values& Values::put(std::int64_t value) {
  return put(std::string_view(fmt::format("{}", value)));
}

Values& Values::put(double value) {
  if (std::isnan(value)) return put_null();
  if (std::isinf(value)) return put(std::string_view(value > 0 ? "Infinity" : "-Infinity"));
  return put(std::string_view(fmt::format("{}", value)));  // the shortest text that is this number and no other
}

Values& Values::put(std::string_view text) {
  texts_.emplace_back(text);
  binary_.push_back(false);
  null_.push_back(false);
  return *this;
}

Values& Values::put(std::span<const std::uint8_t> bytes) {
  texts_.emplace_back(bytes.begin(), bytes.end());
  binary_.push_back(true);
  null_.push_back(false);
  return *this;
}

Values& Values::put_null() {
  texts_.emplace_back();
  binary_.push_back(false);
  null_.push_back(true);
  return *this;
}

void Rows::Clear::operator()(pg_result* handle) const {
  PQclear(handle);
}

int Rows::size() const {
  return PQntuples(handle_.get());
}

bool Rows::is_null(int row, int column) const {
  return PQgetisnull(handle_.get(), row, column) != 0;
}

std::int64_t Rows::integer(int row, int column) const {
  return std::strtoll(PQgetvalue(handle_.get(), row, column), nullptr, 10);
}

double Rows::real(int row, int column) const {
  if (is_null(row, column)) return std::numeric_limits<double>::quiet_NaN();
  return std::strtod(PQgetvalue(handle_.get(), row, column), nullptr);
}

std::string Rows::text(int row, int column) const {
  return {PQgetvalue(handle_.get(), row, column), static_cast<std::size_t>(PQgetlength(handle_.get(), row, column))};
}

std::vector<std::uint8_t> Rows::bytes(int row, int column) const {
  std::size_t length = 0;
  const auto* text = reinterpret_cast<const unsigned char*>(PQgetvalue(handle_.get(), row, column));
  const std::unique_ptr<unsigned char, void (*)(void*)> plain(PQunescapeBytea(text, &length), PQfreemem);
  if (!plain) throw std::bad_alloc();
  return {plain.get(), plain.get() + length};
}

std::int64_t Rows::affected() const {
  return std::strtoll(PQcmdTuples(handle_.get()), nullptr, 10);
}

void Session::Finish::operator()(pg_conn* handle) const {
  PQfinish(handle);
}

Session::Session(const std::string& connection, const std::string& name, std::chrono::seconds answers_within)
    : answers_within_(answers_within) {
  // What is not said: how long a server that went away is waited for.
  const std::string all =
      "connect_timeout=3 keepalives_idle=2 keepalives_interval=1 keepalives_count=3 "
      "tcp_user_timeout=5000 " +
      connection + " application_name='" + name + "'";
  char* wrong = nullptr;
  PQconninfoOption* const parsed = PQconninfoParse(all.c_str(), &wrong);
  if (parsed == nullptr) {
    const std::string why = said(wrong);
    PQfreemem(wrong);
    throw ServerRefuses(fmt::format("the connection to PostgreSQL is written wrongly: {}", why));
  }
  PQconninfoFree(parsed);
  handle_.reset(PQconnectdb(all.c_str()));
  if (PQstatus(handle_.get()) != CONNECTION_OK) {
    const std::string why = said(PQerrorMessage(handle_.get()));
    if (is_own_refusal(why) || servers_refuse(all))
      throw ServerRefuses(fmt::format("PostgreSQL refuses the login: {}; check [postgresql] connection", why));
    throw ServerAway(fmt::format("PostgreSQL cannot be reached: {}", why));
  }
  PQsetNoticeProcessor(
      handle_.get(), [](void*, const char*) {}, nullptr);  // what matters comes as an error
  (void)PQsetnonblocking(handle_.get(), 1);
  // A worker that is stopped in mid-transaction must not hold its partition's row for longer.
  run_script(
      "SET idle_in_transaction_session_timeout = '4s'; SET lock_timeout = '8s'; SET client_min_messages = warning");
}

/// Until there is something to read, or `to_write` room for more. Throws ServerAway once it takes too long.
void Session::wait_for_server(bool to_write, std::chrono::steady_clock::time_point since) {
  int left_ms = -1;  // for as long as it takes
  if (answers_within_.count() > 0) {
    const auto left = since + answers_within_ - std::chrono::steady_clock::now();
    left_ms = static_cast<int>(std::chrono::duration_cast<std::chrono::milliseconds>(left).count());
    if (left_ms <= 0) throw ServerAway(fmt::format("PostgreSQL has not answered for {} s", answers_within_.count()));
  }
  pollfd socket{PQsocket(handle_.get()), static_cast<short>(to_write ? POLLIN | POLLOUT : POLLIN), 0};
  (void)::poll(&socket, 1, left_ms);
}

/// The last result of what was handed to libpq, whose own waiting would last for as long as the server says nothing. It
/// takes no statement behind one that was not answered: the session is over then.
Rows Session::answer(int was_sent, const char* sql) {
  const auto since = std::chrono::steady_clock::now();
  Rows last(nullptr);
  while (was_sent != 0) {
    int unsent = PQflush(handle_.get());
    while (unsent == 1 || PQisBusy(handle_.get()) != 0) {
      wait_for_server(unsent == 1, since);
      if (PQconsumeInput(handle_.get()) == 0) break;  // the connection is over, as the result reports
      if (unsent == 1) unsent = PQflush(handle_.get());
    }
    pg_result* const next = PQgetResult(handle_.get());
    if (next == nullptr) break;
    last = Rows(next);
  }
  check(last.handle_.get(), sql);
  return last;
}

void Session::check(pg_result* result, const char* sql) {
  const ExecStatusType status = PQresultStatus(result);
  if (status == PGRES_COMMAND_OK || status == PGRES_TUPLES_OK) return;
  const char* const state = PQresultErrorField(result, PG_DIAG_SQLSTATE);
  const std::string_view code = state == nullptr ? "08000" : state;
  const std::string why = said(result == nullptr ? PQerrorMessage(handle_.get()) : PQresultErrorMessage(result));
  // Connection, resources, operator intervention, transactions that were rolled back, a server that became a standby,
  // a session that stood still, a lock that did not come.
  for (const char* passing : {"08", "53", "57", "40", "25006", "25P03", "55P03", "XX"}) {
    if (code.starts_with(passing)) throw ServerAway(fmt::format("PostgreSQL: {}", why));
  }
  const std::string what = fmt::format("PostgreSQL: {} ({}, in: {:.60})", why, code, sql);
  constexpr std::string_view missing_row = "23503";  // a row that another refers to: no fault of the content
  for (const char* content : {"22", "23", "54"}) {   // data, a table's rules, a row that is too large
    if (code == missing_row) break;
    if (code.starts_with(content)) throw ContentRefused(what);
  }
  throw ServerRefuses(what);
}

Rows Session::run(const char* sql, const Values& values) {
  const auto count = static_cast<int>(values.texts_.size());
  std::string& name = prepared_[sql];
  if (name.empty()) {
    const std::string wanted = fmt::format("s{}", prepared_.size());
    answer(PQsendPrepare(handle_.get(), wanted.c_str(), sql, 0, nullptr), sql);
    name = wanted;
  }
  std::vector<const char*> texts;
  std::vector<int> lengths, forms;
  for (std::size_t k = 0; k < values.texts_.size(); ++k) {
    texts.push_back(values.null_[k] ? nullptr : values.texts_[k].data());
    lengths.push_back(static_cast<int>(values.texts_[k].size()));
    forms.push_back(values.binary_[k] ? 1 : 0);
  }
  return answer(PQsendQueryPrepared(handle_.get(), name.c_str(), count, texts.data(), lengths.data(), forms.data(), 0),
                sql);
}

void Session::run_script(const std::string& sql) {
  answer(PQsendQuery(handle_.get(), sql.c_str()), sql.c_str());
}

FleetTransaction::FleetTransaction(Session& session) : session_(session) {
  session_.run_script("BEGIN");
}

FleetTransaction::~FleetTransaction() {
  if (!open_) return;
  try {
    session_.run_script("ROLLBACK");
  } catch (const std::exception&) {  // the session is over, and the transaction with it
  }
}

void FleetTransaction::commit() {
  open_ = false;
  session_.run_script("COMMIT");
}

}  // namespace spoolflow::fleet
