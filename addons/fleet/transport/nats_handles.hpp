#pragma once
/// libnats' handles, closed with their owners, and its failures as exceptions: for the sources of this folder alone.
#include <memory>
#include <nats/nats.h>
#include <string>

#include "addons/fleet/transport/nats_access.hpp"

namespace spoolflow::fleet {

[[noreturn]] inline void refuse(natsStatus status, const std::string& what) {
  const char* const last = nats_GetLastError(nullptr);
  std::string text = "NATS: " + what + ": " + natsStatus_GetText(status);
  if (last != nullptr && *last != 0) text += std::string(" (") + last + ")";
  throw TransportError(text);
}

inline void check(natsStatus status, const std::string& what) {
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

}  // namespace spoolflow::fleet
