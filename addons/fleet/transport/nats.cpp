#include "addons/fleet/transport/nats.hpp"

#include <algorithm>
#include <string_view>
#include <thread>

#include "addons/fleet/transport/nats_login.hpp"

namespace spoolflow::fleet {
namespace {

/// Who waits for an answer of JetStream that does not come does nothing else meanwhile, and it answers within
/// milliseconds where it does.
constexpr std::int64_t answer_wait_ms = 1500;
constexpr std::string_view nothing_there = "404", request_over = "408";  // of the server to a request for messages

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

/// For good, by the library.
bool is_closed(natsConnection& connection) {
  return natsConnection_Status(&connection) == NATS_CONN_STATUS_CLOSED;
}

std::string no_room(const StreamSettings& settings) {
  return "NATS: no room for the stream " + settings.name + " of " +
         std::to_string(static_cast<std::int64_t>(settings.largest_MB)) +
         " MB (replicas: " + std::to_string(settings.replicas) +
         "): a server takes three quarters of its free disk, or max_file_store of its configuration; make room "
         "there, or lower [nats] largest_MB of the fleet file";
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

  Handles() = default;
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() {
    if (connection) natsConnection_Close(connection.get());  // its reader has ended then, and subscriptions may
  }
};

std::shared_ptr<Connection::Handles> Connection::made(const NatsAccess& access, const std::string& name) {
  auto out = std::make_shared<Handles>();
  out->options = options_of(access, name);
  natsConnection* connection = nullptr;
  const natsStatus status = natsConnection_Connect(&connection, out->options.get());
  out->connection.reset(connection);
  if (status != NATS_OK && status != NATS_NOT_YET_CONNECTED) refuse(status, "connect");
  jsCtx* stream = nullptr;
  jsOptions options;
  check(jsOptions_Init(&options), "options");
  options.Wait = answer_wait_ms;
  check(natsConnection_JetStream(&stream, connection, &options), "stream");
  out->stream.reset(stream);
  return out;
}

Connection::Connection(const NatsAccess& access, const std::string& name) : access_(access), name_(name) {
  check_login(access, name);
  handles_ = made(access, name);
  made_ = std::chrono::steady_clock::now();
}

Connection::~Connection() = default;

std::shared_ptr<Connection::Handles> Connection::handles() const {
  const std::lock_guard lock(mutex_);
  return handles_;
}

/// Not again and again where servers refuse each.
std::shared_ptr<Connection::Handles> Connection::open_handles() {
  constexpr std::chrono::seconds at_least{1};
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (!is_closed(*handles_->connection) || now - made_ < at_least) return handles_;
  made_ = now;
  try {
    handles_ = made(access_, name_);
  } catch (const TransportError&) {  // the next time
  }
  return handles_;
}

bool Connection::connected() const {
  return natsConnection_Status(handles()->connection.get()) == NATS_CONN_STATUS_CONNECTED;
}

bool Connection::publish(const std::string& subject, std::span<const std::uint8_t> bytes) {
  const auto by = open_handles();
  return natsConnection_Status(by->connection.get()) == NATS_CONN_STATUS_CONNECTED &&
         natsConnection_Publish(by->connection.get(), subject.c_str(), bytes.data(), static_cast<int>(bytes.size())) ==
             NATS_OK;
}

bool Connection::publish(const std::string& subject, const std::string& text) {
  return publish(subject, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

Subscription Connection::subscribe(const std::string& subject) {
  return {*this, subject, open_handles()};
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
  const auto by = open_handles();
  jsStreamInfo* info = nullptr;
  jsErrCode code{};
  natsStatus status = js_AddStream(&info, by->stream.get(), &config, nullptr, &code);
  if (status != NATS_OK && code == JSStreamNameExistErr) {  // it is there with other settings
    status = js_UpdateStream(&info, by->stream.get(), &config, nullptr, &code);
  }
  if (status != NATS_OK && (code == JSStorageResourcesExceededErr || code == JSInsufficientResourcesErr)) {
    throw TransportError(no_room(settings));
  }
  check(status, "stream " + settings.name);
  const Handle<jsStreamInfo> made(info);
  return place_of(*made);
}

std::optional<StreamPlace> Connection::stream(const std::string& name) {
  jsStreamInfo* info = nullptr;
  const natsStatus status = js_GetStreamInfo(&info, open_handles()->stream.get(), name.c_str(), nullptr, nullptr);
  if (status == NATS_NOT_FOUND) return std::nullopt;
  check(status, "stream " + name);
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
  const auto by = open_handles();
  check(js_AddConsumer(&info, by->stream.get(), stream.c_str(), &config, nullptr, nullptr), "read " + subject);
  const Handle<jsConsumerInfo> there(info);
  natsInbox* inbox = nullptr;
  check(natsInbox_Create(&inbox), "inbox");
  const Handle<natsInbox> address(inbox);
  return {by, {stream, there->Name, address.get()}, Subscription(*this, address.get(), by), silent_before};
}

Subscription::Subscription(Connection& connection, std::string subject, std::shared_ptr<Connection::Handles> of)
    : connection_(&connection),
      subject_(std::move(subject)),
      handle_(nullptr, Retire{of->retired}),
      of_(std::move(of)) {
  natsSubscription* made = nullptr;
  check(natsConnection_SubscribeSync(&made, of_->connection.get(), subject_.c_str()), "subscribe to " + subject_);
  handle_.reset(made);
}

std::optional<Message> Subscription::next(std::chrono::milliseconds patience) {
  try {
    if (auto now = connection_->open_handles(); now != of_) *this = Subscription(*connection_, subject_, now);
  } catch (const TransportError&) {  // it is closed again
  }
  if (is_closed(*of_->connection)) {
    std::this_thread::sleep_for(patience);
    return std::nullopt;
  }
  natsMsg* message = nullptr;
  if (natsSubscription_NextMsg(&message, handle_.get(), patience.count()) != NATS_OK) return std::nullopt;
  const Handle<natsMsg> held(message);
  return message_of(message);
}

Puller::Puller(std::shared_ptr<Connection::Handles> handles, Place place, Subscription subscription, int silent_before)
    : handles_(std::move(handles)),
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
    if (const char* header = nullptr; natsMsgHeader_Get(made, "Status", &header) == NATS_OK) {
      const std::string_view verdict(header);
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
