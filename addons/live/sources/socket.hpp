#pragma once
/// Addresses as people write them, and sockets that listen there.
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace spoolflow::live {

/// An address that cannot be used, or a site that asks for what is not there. Exit status 2.
struct SiteError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// "127.0.0.1:8080" or "[::1]:8080".
struct Address {
  std::string host;
  std::uint16_t port = 0;  ///< 0: the system chooses one

  [[nodiscard]] bool is_loopback() const;
  [[nodiscard]] std::string text() const;
};
/// Throws SiteError where the text is no numeric address with a port; `place` is what the message begins with.
[[nodiscard]] Address read_address(const std::string& text, const std::string& place);

/// A machine's address as sockets give it: "192.168.0.7", "fd00::7". Throws SiteError where the text is none: names and
/// networks would match nobody.
[[nodiscard]] std::string read_host(const std::string& text, const std::string& place);

/// A descriptor that is closed with it.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  [[nodiscard]] int number() const { return number_; }
  int release() { return std::exchange(number_, -1); }

 private:
  int number_;
};

/// A bound socket, listening where it is of TCP, and the port that it got. Throws SiteError where the address is in use
/// or is none of this machine.
struct BoundSocket {
  Descriptor descriptor;
  std::uint16_t port;
};
enum class Transport : std::uint8_t { udp, tcp };
[[nodiscard]] BoundSocket bind_socket(const Address& address, Transport transport);

}  // namespace spoolflow::live
