#pragma once
/// Samples of one valve as CSV through a TCP connection or a pipe, header first as in recordings.
#include <filesystem>
#include <thread>
#include <vector>

#include "addons/live/sources/csv_stream.hpp"
#include "addons/live/sources/socket.hpp"

namespace spoolflow::live {

/// Listens for the valve's sender. There is one connection at a time: a new one of an address that may send takes the
/// place of the one before, which may have broken in silence. Any other connection is closed and changes nothing.
class TcpSource {
 public:
  /// A connection of an address that may send.
  struct Caller {
    Descriptor connection{};
    std::string host{};
  };

  /// `allowed` as in UdpReceiver. Throws SiteError.
  TcpSource(const Address& address, std::vector<std::string> allowed, recording::ReadOptions options,
            SourcePosition after, Intake& intake);
  [[nodiscard]] std::uint16_t port() const { return socket_.port; }
  void ask_to_stop() { thread_.request_stop(); }

 private:
  void run(const std::stop_token& stop);
  void answer_callers(int patience_ms);

  BoundSocket socket_;
  std::vector<std::string> allowed_;
  Caller caller_;  ///< waits until the connection before it is given up
  recording::ReadOptions options_;
  std::uint64_t next_;
  Intake& intake_;
  std::jthread thread_;  ///< last: it uses the others
};

/// Reads a named pipe (FIFO), again and again as writers come and go, each with its header; "-" is standard input,
/// once.
class PipeSource {
 public:
  /// Throws SiteError where the path is no pipe.
  PipeSource(std::filesystem::path path, recording::ReadOptions options, SourcePosition after, Intake& intake);
  void ask_to_stop() { thread_.request_stop(); }

 private:
  void run(const std::stop_token& stop);

  std::filesystem::path path_;
  recording::ReadOptions options_;
  std::uint64_t next_;
  Intake& intake_;
  std::jthread thread_;
};

}  // namespace spoolflow::live
