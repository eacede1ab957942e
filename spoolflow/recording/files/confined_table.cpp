#include "spoolflow/recording/files/confined_table.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <new>
#include <stdexcept>
#include <sys/mman.h>
#include <unistd.h>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/fork_server.hpp"
#include "spoolflow/recording/files/matrix_names.hpp"
#include "spoolflow/recording/files/reading_process.hpp"

namespace spoolflow::recording {
namespace {

// What the processes say to each other: the child lists the columns; the parent chooses; then blocks and room for more.
enum class Message : std::uint32_t { listing, choice, room, block, refusal, failure };

constexpr std::size_t blocks = 2;
constexpr std::size_t block_numbers = std::size_t{1} << 17;  // of all chosen columns together

bool send(Connection& to, Message message, std::string_view content = {}) {
  return to.send(static_cast<std::uint32_t>(message), content);
}

/// Numbers and texts one after the other.
class MessageText {
 public:
  void number(std::uint64_t value) {
    std::array<char, sizeof value> bytes{};
    std::memcpy(bytes.data(), &value, sizeof value);
    content_.append(bytes.data(), bytes.size());
  }
  void text(const std::string& value) {
    number(value.size());
    content_ += value;
  }
  [[nodiscard]] const std::string& content() const { return content_; }

 private:
  std::string content_;
};

/// Throws RecordingError where the content ends too soon: what comes from the child is not accepted either.
class ReceivedText {
 public:
  explicit ReceivedText(std::string_view content) : rest_(content) {}
  std::uint64_t number() {
    std::uint64_t value = 0;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string text() { return std::string(take(number())); }

 private:
  std::string_view take(std::uint64_t count) {
    if (count > rest_.size()) throw RecordingError("the process that reads the recording sent nonsense");
    const std::string_view taken = rest_.substr(0, static_cast<std::size_t>(count));
    rest_.remove_prefix(taken.size());
    return taken;
  }
  std::string_view rest_;
};

constexpr std::size_t shared_bytes = blocks * block_numbers * sizeof(double);

double* block(double* numbers, std::uint64_t index) {
  return numbers + (index % blocks) * block_numbers;
}

/// Memory that both processes see. Descriptor -1: new memory, of this process and of what is forked from it.
double* map_numbers(int descriptor) {
  const int kind = descriptor < 0 ? MAP_SHARED | MAP_ANONYMOUS : MAP_SHARED;
  void* const memory = ::mmap(nullptr, shared_bytes, PROT_READ | PROT_WRITE, kind, descriptor, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  return static_cast<double*>(memory);
}

/// The parent's. A child of the fork server, which does not have this process's memory, is given its descriptor.
class SharedNumbers {
 public:
  SharedNumbers() {
    if (ForkServer::present() != nullptr) make_descriptor();
    try {
      numbers_ = map_numbers(descriptor_);
    } catch (...) {
      close();
      throw;
    }
  }
  ~SharedNumbers() {
    ::munmap(numbers_, shared_bytes);
    close();
  }
  SharedNumbers(const SharedNumbers&) = delete;
  SharedNumbers& operator=(const SharedNumbers&) = delete;
  [[nodiscard]] int descriptor() const { return descriptor_; }
  [[nodiscard]] double* numbers() const { return numbers_; }

 private:
  /// Neither process can make the memory smaller under the other.
  void make_descriptor() {
    descriptor_ = ::memfd_create("samples", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    if (descriptor_ >= 0 && ::ftruncate(descriptor_, shared_bytes) == 0 &&
        ::fcntl(descriptor_, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) == 0) {
      return;
    }
    const int failure = errno;
    close();
    throw std::runtime_error(fmt::format(
        "the process that reads the recording can share no memory: {}{}", std::strerror(failure),
        failure == EFBIG ? "; allow files of 2 MiB and more (ulimit -f), or read one recording at a time" : ""));
  }
  void close() const {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  int descriptor_ = -1;
  double* numbers_ = nullptr;
};

/// As many as there is room for; VectorTable holds no more columns than numbers fit.
std::size_t rows_of_block(std::size_t columns) {
  return block_numbers / std::max<std::size_t>(1, columns);
}

std::string listing_of(const VectorTable& table) {
  MessageText out;
  const std::vector<UnreadPart> unread = table.unread();
  out.number(unread.size());
  for (const UnreadPart& part : unread) {
    for (const std::string* text : {&part.column, &part.what}) out.text(*text);
  }
  out.text(table.lost());
  out.number(table.columns().size());
  for (std::size_t k = 0; k < table.columns().size(); ++k) {
    const FileColumn& column = table.columns()[k];
    for (const std::string* text : {&column.name, &column.leaf, &column.unit, &column.unapplied}) out.text(*text);
    out.number(column.wave.stretches().size());
    for (const EvenStretch& stretch : column.wave.stretches()) {
      out.number(stretch.first);
      for (const double value : {stretch.begin_s, stretch.step_s}) out.number(std::bit_cast<std::uint64_t>(value));
    }
    out.number(table.length(k));
  }
  return out.content();
}

/// The child's work: what is chosen, block after block, each as soon as there is room for it.
void send_blocks(VectorTable& table, double* numbers, Connection& parent) {
  std::uint32_t kind = 0;
  std::string content;
  if (!parent.receive(kind, content) || kind != static_cast<std::uint32_t>(Message::choice)) return;
  ReceivedText chosen(content);
  std::vector<std::size_t> columns(static_cast<std::size_t>(chosen.number()));
  for (std::size_t& column : columns) column = static_cast<std::size_t>(chosen.number());
  table.select(columns);
  const std::size_t rows = rows_of_block(columns.size());
  const std::uint64_t length = columns.empty() ? 0 : table.length(columns.front());
  std::uint64_t first = 0;
  for (std::uint64_t index = 0; first < length; ++index) {
    if (index >= blocks && !parent.receive(kind, content)) return;
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(rows, length - first));
    for (std::size_t k = 0; k < columns.size(); ++k) {
      table.copy(columns[k], first, count, block(numbers, index) + k * rows);
    }
    if (!send(parent, Message::block)) return;
    first += count;
  }
  (void)parent.receive(kind, content);  // until the parent is gone
}

void read_in_child(const ReadingOrder& order, Connection& parent) {
  ReceivedText bytes(order.bytes);
  const auto open = reinterpret_cast<OpenVectors>(static_cast<std::uintptr_t>(bytes.number()));
  auto* const inherited = reinterpret_cast<double*>(static_cast<std::uintptr_t>(bytes.number()));
  const bool text_is_missing = bytes.number() != 0;
  const std::filesystem::path file(bytes.text());
  try {
    double* const numbers = order.memory < 0 ? inherited : map_numbers(order.memory);
    const std::unique_ptr<VectorTable> table = open(file);
    give_up_opening();
    table->look();
    if (text_is_missing) table->take_text_as_missing();
    if (send(parent, Message::listing, listing_of(*table))) send_blocks(*table, numbers, parent);
  } catch (const RecordingError& error) {
    (void)send(parent, Message::refusal, error.what());
  } catch (const std::bad_alloc&) {
    (void)send(parent, Message::refusal,
               fmt::format("{}: needs more than {} MiB of memory to read, which is out of all "
                           "proportion to its size; it is damaged, or record it in parts",
                           file.string(), order.limits.memory_bytes >> 20));
  } catch (const std::exception& error) {
    (void)send(parent, Message::failure, error.what());
  }
}

/// An order for the file: addresses, that of a function being the same in every forked process, and the path.
ReadingOrder order_of(const std::filesystem::path& file, std::uint64_t file_bytes, OpenVectors open,
                      bool text_is_missing, const SharedNumbers& shared) {
  MessageText bytes;
  bytes.number(reinterpret_cast<std::uintptr_t>(open));
  bytes.number(reinterpret_cast<std::uintptr_t>(shared.numbers()));
  bytes.number(text_is_missing ? 1 : 0);
  bytes.text(file.string());
  return {read_in_child, reading_limits(file_bytes), bytes.content(), shared.descriptor()};
}

class ConfinedTable final : public VectorTable {
 public:
  ConfinedTable(const std::filesystem::path& path, std::uint64_t file_bytes, OpenVectors open, bool text_is_missing)
      : VectorTable(path.string()), process_(order_of(path, file_bytes, open, text_is_missing, shared_)) {
    ReceivedText content(expect(Message::listing));
    for (std::uint64_t left = content.number(); left > 0; --left) {
      UnreadPart part;
      for (std::string* text : {&part.column, &part.what}) *text = content.text();
      unread_.push_back(std::move(part));
    }
    lost_ = content.text();
    std::vector<FileColumn> columns;
    std::vector<std::uint64_t> lengths;
    for (std::uint64_t left = content.number(); left > 0; --left) {
      FileColumn& column = columns.emplace_back();
      for (std::string* text : {&column.name, &column.leaf, &column.unit, &column.unapplied}) *text = content.text();
      for (std::uint64_t stretches = content.number(); stretches > 0; --stretches) {
        EvenStretch stretch{content.number()};
        for (double* value : {&stretch.begin_s, &stretch.step_s}) *value = std::bit_cast<double>(content.number());
        column.wave.add(stretch);
      }
      lengths.push_back(content.number());
    }
    number_equal_names(columns);
    for (std::size_t k = 0; k < columns.size(); ++k) add({std::move(columns[k]), lengths[k]});
  }

  [[nodiscard]] std::vector<UnreadPart> unread() const override { return unread_; }
  [[nodiscard]] std::string lost() const override { return lost_; }

  void copy(std::size_t column, std::uint64_t first, std::size_t count, double* out) override {
    const double* const values = block(shared_.numbers(), index_) + slot_of_.at(column) * rows_ + (first - first_);
    std::copy_n(values, count, out);
  }

 protected:
  void chosen(const std::vector<std::size_t>& columns) override {
    slot_of_.assign(this->columns().size(), 0);
    MessageText message;
    message.number(columns.size());
    for (std::size_t k = 0; k < columns.size(); ++k) {
      slot_of_.at(columns[k]) = k;
      message.number(columns[k]);
    }
    rows_ = rows_of_block(columns.size());
    if (!send(process_.connection(), Message::choice, message.content())) refuse_end();
  }

  std::size_t at_once(std::uint64_t first, std::size_t wanted) override {
    if (!begun_ || first >= first_ + rows_) {
      if (begun_) {
        (void)send(process_.connection(),
                   Message::room);  // where the child is gone, what it said last is still to be read
        first_ += rows_;
        ++index_;
      }
      begun_ = true;
      (void)expect(Message::block);
    }
    return std::min<std::size_t>(wanted, static_cast<std::size_t>(first_ + rows_ - first));
  }

 private:
  [[noreturn]] void refuse_end() {
    throw RecordingError(fmt::format("{}: is damaged or hostile: the process that read it {}; copy or record it again",
                                     file(), process_.end()));
  }

  /// The content of the child's next message, valid until the one after.
  std::string_view expect(Message wanted) {
    std::uint32_t kind = 0;
    if (!process_.connection().receive(kind, content_)) refuse_end();
    const auto message = static_cast<Message>(kind);
    if (message == Message::refusal) throw RecordingError(content_);
    if (message == Message::failure) throw std::runtime_error(content_);
    if (message != wanted) refuse_end();
    return content_;
  }

  SharedNumbers shared_;
  ReadingProcess process_;
  std::string content_;
  std::vector<UnreadPart> unread_;
  std::string lost_;
  std::vector<std::size_t> slot_of_;
  std::size_t rows_ = 0;     ///< of a block
  std::uint64_t first_ = 0;  ///< sample with which the block at hand begins
  std::uint64_t index_ = 0;  ///< of the block at hand
  bool begun_ = false;
};

}  // namespace

std::unique_ptr<SampleTable> open_confined(const std::filesystem::path& file, std::uint64_t file_bytes,
                                           OpenVectors open, bool text_is_missing) {
  try {
    return std::make_unique<ConfinedTable>(file, file_bytes, open, text_is_missing);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace spoolflow::recording
