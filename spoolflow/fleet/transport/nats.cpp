#include "spoolflow/fleet/transport/nats.hpp"

#include <algorithm>
#include <array>
#include <nats/nats.h>
#include <string_view>

namespace spoolflow::fleet {
namespace {

[[noreturn]] void refuse(natsStatus status, const std::string& what) {
  const char* const last = nats_GetLastError(nullptr);
  std::string text = "NATS: " + what + ": " + natsStatus_GetText(status);
  if (last != nullptr && *last != 0) text += std::string(" (") + last + ")";
  throw TransportError(text);
}

void check(natsStatus status, const std::string& what) {
  if (status != NATS_OK) refuse(status, what);
}

struct Destroy {
  void operator()(natsOptions* handle) const { natsOptions_Destroy(handle); }
  void operator()(natsConnection* handle) const { natsConnection_Destroy(handle); }
  void operator()(jsCtx* handle) const { jsCtx_Destroy(handle); }
  void operator()(jsStreamInfo* handle) const { jsStreamInfo_Destroy(handle); }
  void operator()(jsConsumerInfo* handle) const { jsConsumerInfo_Destroy(handle); }
  void operator()(natsInbox* handle) const { natsInbox_Destroy(handle); }
  void operator()(natsMsg* handle) const { natsMsg_Destroy(handle); }
  void operator()(jsMsgMetaData* handle) const { jsMsgMetaData_Destroy(handle); }
};
template <class T>
using Handle = std::unique_ptr<T, Destroy>;

/// Several connection attempts fit a broken server's absence. Who waits for an answer of JetStream that does not come
/// does nothing else meanwhile, and it answers within milliseconds where it does; a server that stands takes no bytes.
constexpr std::int64_t reconnect_wait_ms = 250, answer_wait_ms = 1500, ping_interval_ms = 2000, write_wait_ms = 3000;
constexpr int pings_out = 2;
constexpr std::string_view nothing_there = "404", request_over = "408";  // of the server to a request for messages

Handle<natsOptions> options_of(const NatsAccess& access, const std::string& name) {
  natsOptions* made = nullptr;
  check(natsOptions_Create(&made), "options");
  Handle<natsOptions> options(made);
  std::vector<const char*> servers;
  for (const std::string& server : access.servers) servers.push_back(server.c_str());
  check(natsOptions_SetServers(made, servers.data(), static_cast<int>(servers.size())), "servers");
  check(natsOptions_SetName(made, name.c_str()), "name");
  check(natsOptions_SetMaxReconnect(made, -1), "reconnects");
  check(natsOptions_SetReconnectWait(made, reconnect_wait_ms), "reconnects");
  check(natsOptions_SetRetryOnFailedConnect(
            made, true, [](natsConnection*, void*) {}, nullptr),
        "reconnects");
  // Only the servers that were named: others that those tell of may be out of reach from here.
  check(natsOptions_SetIgnoreDiscoveredServers(made, true), "servers");
  check(natsOptions_SetPingInterval(made, ping_interval_ms), "pings");
  check(natsOptions_SetMaxPingsOut(made, pings_out), "pings");
  check(natsOptions_SetWriteDeadline(made, write_wait_ms), "writes");
  const auto login = [](natsStatus status, const std::string& what, const std::string& remedy) {
    if (status == NATS_OK) return;
    throw LoginError("NATS: " + what + " (" + natsStatus_GetText(status) + "); " + remedy);
  };
  if (!access.credentials.empty()) {
    login(natsOptions_SetUserCredentialsFromFiles(made, access.credentials.c_str(), nullptr),
          "the credentials " + access.credentials + " cannot be used", "check the file and its rights");
  }
  if (!access.user.empty()) {
    login(natsOptions_SetUserInfo(made, access.user.c_str(), access.password.c_str()), "the user cannot be used",
          "check user and password_file");
  }
  if (!access.authority.empty()) {
    login(natsOptions_SetSecure(made, true), "TLS cannot be used", "check libnats");
    login(natsOptions_LoadCATrustedCertificates(made, access.authority.c_str()),
          "the certificates " + access.authority + " cannot be read", "name a PEM file as authority");
  }
  // What comes before there is an answer is refused by the servers later: the connection goes on trying.
  return options;
}

/// What another try does not help: who we are, and whether both sides speak TLS and trust each other.
bool is_refusal(natsStatus status) {
  return status == NATS_CONNECTION_AUTH_FAILED || status == NATS_NOT_PERMITTED || status == NATS_SSL_ERROR ||
         status == NATS_SECURE_CONNECTION_WANTED || status == NATS_SECURE_CONNECTION_REQUIRED;
}

/// Asks one server after the other until one lets us in; the connection itself would go on trying in silence.
/// Throws LoginError where one refuses us; servers that are away, or do not answer in time, are passed over. Returns
/// whether one let us in.
bool let_in(const NatsAccess& access, const std::string& name, std::int64_t answer_within_ms) {
  for (const std::string& server : access.servers) {
    NatsAccess one = access;
    one.servers = {server};
    const Handle<natsOptions> options = options_of(one, name);
    check(natsOptions_SetRetryOnFailedConnect(options.get(), false, nullptr, nullptr), "options");
    check(natsOptions_SetAllowReconnect(options.get(), false), "options");
    check(natsOptions_SetTimeout(options.get(), answer_within_ms), "options");
    natsConnection* made = nullptr;
    const natsStatus status = natsConnection_Connect(&made, options.get());
    const Handle<natsConnection> connection(made);
    if (status == NATS_OK) return true;
    if (!is_refusal(status)) continue;
    const char* const last = nats_GetLastError(nullptr);
    throw LoginError("NATS: " + server + " refuses this user or its TLS: " + natsStatus_GetText(status) +
                     (last != nullptr && *last != 0 ? std::string(" (") + last + ")" : "") +
                     "; check user, password_file or credentials, and authority");
  }
  return false;
}

/// A busy server needs longer for TLS and a password than one that is away is worth.
void check_login(const NatsAccess& access, const std::string& name) {
  constexpr std::array<std::int64_t, 2> patience_ms{1000, 5000};
  for (const std::int64_t one : patience_ms) {
    if (let_in(access, name, one)) return;
  }
}

Message message_of(natsMsg* handle) {
  Message out{natsMsg_GetSubject(handle),
              std::string(natsMsg_GetData(handle), static_cast<std::size_t>(natsMsg_GetDataLength(handle)))};
  jsMsgMetaData* made = nullptr;
  if (natsMsg_GetReply(handle) != nullptr && natsMsg_GetMetaData(&made, handle) == NATS_OK) {
    const Handle<jsMsgMetaData> data(made);
    out.sequence = data->Sequence.Stream;
  }
  return out;
}

StreamPlace place_of(const jsStreamInfo& info) {
  return {info.Created, info.State.FirstSeq, info.State.LastSeq, info.State.Msgs, info.State.Bytes};
}

}  // namespace

struct Connection::Handles {
  Handle<natsOptions> options;
  Handle<natsConnection> connection;
  Handle<jsCtx> stream;
  std::shared_ptr<RetiredSubscriptions> retired = std::make_shared<RetiredSubscriptions>();
};

Connection::Connection(const NatsAccess& access, const std::string& name) : handles_(std::make_unique<Handles>()) {
  check_login(access, name);
  handles_->options = options_of(access, name);
  natsConnection* connection = nullptr;
  const natsStatus status = natsConnection_Connect(&connection, handles_->options.get());
  handles_->connection.reset(connection);
  if (status != NATS_OK && status != NATS_NOT_YET_CONNECTED) refuse(status, "connect");
  jsCtx* stream = nullptr;
  jsOptions options;
  check(jsOptions_Init(&options), "options");
  options.Wait = answer_wait_ms;
  check(natsConnection_JetStream(&stream, connection, &options), "stream");
  handles_->stream.reset(stream);
}

Connection::~Connection() {
  natsConnection_Close(handles_->connection.get());  // its reader has ended then, and subscriptions may
}

bool Connection::connected() const {
  return natsConnection_Status(handles_->connection.get()) == NATS_CONN_STATUS_CONNECTED;
}

bool Connection::publish(const std::string& subject, std::span<const std::uint8_t> bytes) {
  return connected() && natsConnection_Publish(handles_->connection.get(), subject.c_str(), bytes.data(),
                                               static_cast<int>(bytes.size())) == NATS_OK;
}

bool Connection::publish(const std::string& subject, const std::string& text) {
  return connected() && natsConnection_Publish(handles_->connection.get(), subject.c_str(), text.data(),
                                               static_cast<int>(text.size())) == NATS_OK;
}

Subscription Connection::subscribe(const std::string& subject) {
  natsSubscription* made = nullptr;
  check(natsConnection_SubscribeSync(&made, handles_->connection.get(), subject.c_str()), "subscribe to " + subject);
  return {made, handles_->retired};
}

StreamPlace Connection::make_stream(const StreamSettings& settings) {
  jsStreamConfig config;
  check(jsStreamConfig_Init(&config), "stream");
  const char* subject = "spoolflow.block.>";
  config.Name = settings.name.c_str();
  config.Subjects = &subject;
  config.SubjectsLen = 1;
  config.Storage = js_FileStorage;
  config.Discard = js_DiscardOld;
  config.Replicas = settings.replicas;
  config.MaxBytes = static_cast<std::int64_t>(1e6 * settings.largest_MB);
  config.MaxAge = static_cast<std::int64_t>(3.6e12 * settings.hours);
  config.Duplicates = std::int64_t{1'000'000'000};  // none are looked for
  config.NoAck = true;
  jsStreamInfo* info = nullptr;
  jsErrCode code{};
  natsStatus status = js_AddStream(&info, handles_->stream.get(), &config, nullptr, &code);
  if (status != NATS_OK && code != 0) {  // it is there with other settings
    status = js_UpdateStream(&info, handles_->stream.get(), &config, nullptr, &code);
  }
  check(status, "stream " + settings.name);
  const Handle<jsStreamInfo> made(info);
  return place_of(*made);
}

StreamPlace Connection::stream(const std::string& name) {
  jsStreamInfo* info = nullptr;
  check(js_GetStreamInfo(&info, handles_->stream.get(), name.c_str(), nullptr, nullptr), "stream " + name);
  const Handle<jsStreamInfo> found(info);
  return place_of(*found);
}

Puller Connection::pull(const std::string& stream, const std::string& subject, std::uint64_t from, int silent_before) {
  jsConsumerConfig config;
  check(jsConsumerConfig_Init(&config), "reader");
  config.DeliverPolicy = from > 1 ? js_DeliverByStartSequence : js_DeliverAll;
  config.OptStartSeq = from > 1 ? from : 0;
  config.FilterSubject = subject.c_str();
  config.AckPolicy = js_AckNone;
  config.InactiveThreshold = std::int64_t{30'000'000'000};
  config.MemoryStorage = true;
  config.Replicas = 1;
  jsConsumerInfo* info = nullptr;
  check(js_AddConsumer(&info, handles_->stream.get(), stream.c_str(), &config, nullptr, nullptr), "read " + subject);
  const Handle<jsConsumerInfo> there(info);
  natsInbox* inbox = nullptr;
  check(natsInbox_Create(&inbox), "inbox");
  const Handle<natsInbox> address(inbox);
  return {*handles_, {stream, there->Name, address.get()}, subscribe(address.get()), silent_before};
}

std::optional<Message> Subscription::next(std::chrono::milliseconds patience) {
  natsMsg* message = nullptr;
  if (natsSubscription_NextMsg(&message, handle_.get(), patience.count()) != NATS_OK) return std::nullopt;
  const Handle<natsMsg> held(message);
  return message_of(message);
}

Puller::Puller(Connection::Handles& handles, Place place, Subscription subscription, int silent_before)
    : handles_(&handles),
      place_(std::move(place)),
      subscription_(std::move(subscription)),
      watch_(std::chrono::steady_clock::now(), silent_before) {}

/// What the server has not sent by then it forgets.
void Puller::ask(int most, Time now) {
  constexpr std::chrono::seconds forgotten_after{1}, on_its_way{1};
  const std::string request = "{\"batch\":" + std::to_string(most) +
                              ",\"expires\":" + std::to_string(std::chrono::nanoseconds(forgotten_after).count()) + "}";
  const std::string subject = "$JS.API.CONSUMER.MSG.NEXT." + place_.stream + "." + place_.consumer;
  check(natsConnection_PublishRequestString(handles_->connection.get(), subject.c_str(), place_.inbox.c_str(),
                                            request.c_str()),
        "ask for messages");
  owed_ = most;
  owed_until_ = now + forgotten_after + on_its_way;
}

void Puller::look_whether_it_is_there(Time now) {
  jsConsumerInfo* info = nullptr;
  check(js_GetConsumerInfo(&info, handles_->stream.get(), place_.stream.c_str(), place_.consumer.c_str(), nullptr,
                           nullptr),
        "reader");
  const Handle<jsConsumerInfo> there(info);
  if (there->NumPending > 0) refuse(NATS_TIMEOUT, "reader that does not say what it has");
  watch_.answered(now);
}

std::vector<Message> Puller::fetch(int most, std::chrono::milliseconds patience) {
  const auto clock = std::chrono::steady_clock::now;
  const Time begin = clock();
  std::vector<Message> out;
  while (static_cast<int>(out.size()) < most) {
    const Time now = clock();
    if (owed_ <= 0 || now >= owed_until_) {
      if (!out.empty()) break;  // the next request is sent when these are worked on
      ask(most, now);
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(begin + patience - now);
    natsMsg* made = nullptr;
    const natsStatus status =
        natsSubscription_NextMsg(&made, subscription_.handle_.get(), std::max<std::int64_t>(left.count(), 0));
    if (status == NATS_TIMEOUT) break;
    if (status != NATS_OK) refuse(status, "fetch");
    const Handle<natsMsg> message(made);
    if (const char* told = nullptr; natsMsgHeader_Get(made, "Status", &told) == NATS_OK) {
      const std::string_view verdict(told);
      // Of a request: that it found nothing or is over; else that nobody takes it, or will not.
      if (verdict != nothing_there && verdict != request_over) refuse(NATS_NO_RESPONDERS, "fetch");
      owed_ = 0;
      continue;
    }
    --owed_;
    out.push_back(message_of(made));
  }
  if (!out.empty()) {
    watch_.heard(clock());
    return out;
  }
  const ReaderWatch::Step step = watch_.silent(clock());
  if (step == ReaderWatch::Step::renew) refuse(NATS_TIMEOUT, "reader that says nothing");
  if (step == ReaderWatch::Step::ask) look_whether_it_is_there(clock());
  return out;
}

}  // namespace spoolflow::fleet
