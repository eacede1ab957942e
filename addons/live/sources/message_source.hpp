#pragma once
/// Samples of one valve in messages of a broker: CSV or JSON (message_text.hpp), read as one stream of CSV.
#include <condition_variable>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "addons/live/sources/csv_stream.hpp"
#include "addons/live/sources/socket.hpp"

namespace spoolflow::live {

class MessageSource {
 public:
  /// `name` stands in messages. Throws std::system_error where there is no thread.
  MessageSource(std::string name, recording::ReadOptions options, SourcePosition after, Intake& intake);

  /// From one thread; it waits a second at the most where the reader has not come that far. What cannot be read is
  /// counted, and reported to the intake. A message with other columns than those before begins as a new sender does.
  void take(std::string_view message);
  /// From any thread: why nothing can come; empty: nothing stands in the way.
  void set_trouble(const std::string& trouble) { intake_.set_trouble(trouble); }
  void ask_to_stop() { thread_.request_stop(); }

 private:
  enum class Written : unsigned char { whole, nobody_reads, no_room };

  void run(const std::stop_token& stop);
  bool begin(const std::string& header);
  [[nodiscard]] Written write(std::string_view text) const;

  std::string name_;
  recording::ReadOptions options_;
  std::uint64_t next_;
  Intake& intake_;
  std::string header_{};  ///< of the stream that writer_ writes
  Descriptor writer_{};
  bool was_unreadable_ = false;
  std::mutex mutex_{};
  std::condition_variable_any changed_{};
  Descriptor waiting_{};  ///< a new stream that the thread has not begun to read
  std::jthread thread_;   ///< last: it uses the others
};

}  // namespace spoolflow::live
