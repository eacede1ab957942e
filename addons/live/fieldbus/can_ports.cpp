#include "addons/live/fieldbus/can_ports.hpp"

#include <arpa/inet.h>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fmt/format.h>

#include "addons/live/protocols/can_text.hpp"

namespace spoolflow::live {
namespace {

using sensor::CanFrame;

/// The kernel's raw CAN sockets.
class SocketCan : public CanPort {
 public:
  explicit SocketCan(std::string interface) : interface_(std::move(interface)) {
    open();
    if (!trouble_.empty()) {
      throw SiteError(
          fmt::format("[can] {}; `ip link` lists what there is (ip link set {} up type can bitrate 250000), "
                      "and log = \"bus.log\" or udp do without",
                      trouble_, interface_));
    }
  }
  bool send(const CanFrame& frame, double) override {
    if (!trouble_.empty()) return false;
    can_frame out{};
    out.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U);
    out.can_dlc = frame.size;
    std::memcpy(out.data, frame.data.data(), frame.data.size());
    if (::write(socket_.number(), &out, sizeof out) == sizeof out) return true;
    if (errno != ENOBUFS && errno != EAGAIN) trouble_ = fmt::format("{}: {}", interface_, std::strerror(errno));
    return false;
  }
  std::optional<CanFrame> receive() override {
    can_frame in{};
    while (::read(socket_.number(), &in, sizeof in) == sizeof in) {
      if ((in.can_id & (CAN_RTR_FLAG | CAN_ERR_FLAG)) != 0 || in.can_dlc > 8) continue;
      CanFrame out;
      out.extended = (in.can_id & CAN_EFF_FLAG) != 0;
      out.id = in.can_id & (out.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
      out.size = in.can_dlc;
      std::memcpy(out.data.data(), in.data, out.data.size());
      return out;
    }
    return std::nullopt;
  }
  bool look_after() override {
    if (trouble_.empty()) return false;
    open();
    return trouble_.empty();
  }

 private:
  void open() {
    trouble_.clear();
    socket_ = Descriptor(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
    if (socket_.number() < 0) {
      trouble_ = fmt::format("this kernel has no CAN for {}: {}", interface_, std::strerror(errno));
      return;
    }
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex(interface_.c_str()));
    if (address.can_ifindex == 0 ||
        ::bind(socket_.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      trouble_ = fmt::format("no CAN interface {}: {}", interface_, std::strerror(errno));
      return;
    }
    ifreq state{};
    interface_.copy(state.ifr_name, sizeof state.ifr_name - 1);
    // The kernel binds to an interface that is down, too.
    if (::ioctl(socket_.number(), SIOCGIFFLAGS, &state) != 0 || (state.ifr_flags & IFF_UP) == 0) {
      trouble_ = fmt::format("the CAN interface {} is down", interface_);
    }
  }
  std::string interface_;
  Descriptor socket_;
};

/// candump's log or Vector's ASC, by the file's suffix.
class CanLog : public CanPort {
 public:
  CanLog(std::filesystem::path file, double largest_MB)
      : file_(std::move(file)), is_asc_(file_.extension() == ".asc"), largest_(largest_MB * 1e6) {
    begin();
    if (!trouble_.empty()) throw SiteError(fmt::format("[can] {}; name a file in a folder that is there", trouble_));
  }
  ~CanLog() override {
    if (out_ == nullptr) return;
    if (is_asc_ && started_s_ != 0) (void)std::fputs("End TriggerBlock\n", out_);
    (void)std::fclose(out_);
  }
  bool send(const CanFrame& frame, double time_s) override {
    if (out_ == nullptr) return false;
    std::string text;
    if (is_asc_ && started_s_ == 0) text = fieldbus::asc_beginning(started_s_ = time_s);
    text += is_asc_ ? fieldbus::asc_line(frame, time_s - started_s_) : fieldbus::candump_line(frame, time_s, "can0");
    written_ += static_cast<double>(text.size());
    return std::fputs(text.c_str(), out_) >= 0;
  }
  bool look_after() override {
    if (out_ != nullptr && std::fflush(out_) != 0) fail();
    if (out_ != nullptr && written_ < largest_) return false;
    if (out_ != nullptr) {
      if (is_asc_) (void)std::fputs("End TriggerBlock\n", out_);
      (void)std::fclose(out_);
      out_ = nullptr;
      std::error_code ignored;
      std::filesystem::rename(file_, file_.string() + ".1", ignored);
    }
    begin();
    return false;
  }

 private:
  void begin() {
    trouble_.clear();
    // A log grows as long as the program runs, as a bus does: no output that is there whole or not at all.
    Descriptor file(::open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (is_asc_ ? O_TRUNC : O_APPEND), 0644));
    out_ = file.number() < 0 ? nullptr : ::fdopen(file.number(), "w");
    if (out_ != nullptr) (void)file.release();
    started_s_ = written_ = 0;
    if (out_ == nullptr) trouble_ = fmt::format("{} cannot be written: {}", file_.string(), std::strerror(errno));
  }
  void fail() {
    trouble_ = fmt::format("{} cannot be written: {}", file_.string(), std::strerror(errno));
    (void)std::fclose(out_);
    out_ = nullptr;
  }
  std::filesystem::path file_;
  bool is_asc_;
  double largest_;
  std::FILE* out_ = nullptr;
  double started_s_ = 0, written_ = 0;
};

/// A multicast group; own datagrams come back and are known by their sender's port.
class CanUdp : public CanPort {
 public:
  CanUdp(const Address& group, const std::string& through)
      : sender_(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)),
        receiver_(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    group_.sin_family = AF_INET;
    group_.sin_port = htons(group.port);
    ip_mreq membership{};
    const bool is_group = ::inet_pton(AF_INET, group.host.c_str(), &group_.sin_addr) == 1 &&
                          IN_MULTICAST(ntohl(group_.sin_addr.s_addr)) && group.port != 0;
    const bool is_interface = ::inet_pton(AF_INET, through.c_str(), &membership.imr_interface) == 1;
    if (!is_group || !is_interface) {
      throw SiteError(
          fmt::format("[can] udp is '{}' through '{}'; it must be an IPv4 multicast group such as "
                      "239.74.163.2:43113, through the address of a network interface such as 127.0.0.1",
                      group.text(), through));
    }
    membership.imr_multiaddr = group_.sin_addr;
    const int yes = 1;
    const auto* const at = reinterpret_cast<const sockaddr*>(&group_);
    const bool works =
        ::setsockopt(receiver_.number(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) == 0 &&
        ::bind(receiver_.number(), at, sizeof group_) == 0 &&
        ::setsockopt(receiver_.number(), IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) == 0 &&
        ::setsockopt(sender_.number(), IPPROTO_IP, IP_MULTICAST_IF, &membership.imr_interface,
                     sizeof membership.imr_interface) == 0 &&
        ::connect(sender_.number(), at, sizeof group_) == 0;
    socklen_t size = sizeof own_;
    if (!works || ::getsockname(sender_.number(), reinterpret_cast<sockaddr*>(&own_), &size) != 0) {
      throw SiteError(fmt::format("[can] the group {} cannot be joined through {}: {}; name another udp or udp_through",
                                  group.text(), through, std::strerror(errno)));
    }
  }
  bool send(const CanFrame& frame, double time_s) override {
    const std::string bytes = fieldbus::can_datagram(frame, time_s);
    return ::send(sender_.number(), bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size());
  }
  std::optional<CanFrame> receive() override {
    std::array<char, 2048> bytes{};
    sockaddr_in from{};
    socklen_t size = sizeof from;
    ssize_t got = 0;
    while ((got = ::recvfrom(receiver_.number(), bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&from),
                             &size)) >= 0) {
      if (from.sin_port == own_.sin_port && from.sin_addr.s_addr == own_.sin_addr.s_addr) continue;
      if (const auto frame = fieldbus::read_can_datagram({bytes.data(), static_cast<std::size_t>(got)})) return frame;
    }
    return std::nullopt;
  }

 private:
  Descriptor sender_, receiver_;
  sockaddr_in group_{}, own_{};
};

}  // namespace

std::vector<std::unique_ptr<CanPort>> open_can_ports(const CanSettings& settings) {
  std::vector<std::unique_ptr<CanPort>> out;
  if (!settings.interface.empty()) out.push_back(std::make_unique<SocketCan>(settings.interface));
  if (!settings.log.empty()) out.push_back(std::make_unique<CanLog>(settings.log, settings.log_largest_MB));
  if (settings.udp) out.push_back(std::make_unique<CanUdp>(*settings.udp, settings.udp_through));
  return out;
}

}  // namespace spoolflow::live
