#include "spoolflow/recording/mdf4/mdf4_walk.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace spoolflow::recording {
namespace {

constexpr std::uint64_t bytes_at_once = std::uint64_t{1} << 18U;
constexpr std::uint64_t length_bytes = 4;

std::uint64_t whole(const std::uint8_t* from, std::uint64_t bytes) {
  std::uint64_t out = 0;
  for (std::uint64_t k = bytes; k-- > 0;) out = out << 8U | from[k];
  return out;
}

}  // namespace

const std::uint8_t* Mdf4Bytes::from(std::uint64_t at, std::uint64_t count) {
  if (at < begin_ || at + count > begin_ + buffer_.size()) {
    if (at > stream_->size() || count > stream_->size() - at) refuse_mdf4(of_, "its records end too soon");
    buffer_.resize(static_cast<std::size_t>(std::min(stream_->size() - at, std::max(bytes_at_once, count))));
    begin_ = at;
    stream_->read(at, buffer_);
  }
  return buffer_.data() + (at - begin_);
}

Mdf4Walk::Mdf4Walk(const Mdf4Group& group)
    : group_(&group), bytes_(group.records->stream, group.what()), apart_(group.records->invalid, group.what()) {}

std::uint64_t Mdf4Walk::next_own() {
  const Mdf4Records& records = *group_->records;
  const std::uint64_t number_bytes = records.number_bytes;
  for (;;) {
    const std::uint64_t number =
        number_bytes == 0 ? group_->number : whole(bytes_.from(at_, number_bytes), number_bytes);
    at_ += number_bytes;
    if (number == group_->number || records.bytes.size() == 1) return at_;
    const auto kind = records.bytes.find(number);
    if (kind == records.bytes.end()) {
      refuse_mdf4(group_->what(), fmt::format("records of the number {}, which no group has", number));
    }
    at_ += records.of_any_length.at(number) ? length_bytes + whole(bytes_.from(at_, length_bytes), length_bytes)
                                            : kind->second;
  }
}

void Mdf4Walk::show(std::uint64_t first, std::size_t count,
                    const std::function<void(const std::uint8_t*, std::uint64_t)>& record) {
  const Mdf4Records& records = *group_->records;
  const std::uint64_t each = group_->record_bytes + records.number_bytes;
  if (records.bytes.size() == 1) {
    at_ = first * each, next_ = first;
  } else if (first < next_) {
    at_ = 0, next_ = 0;
  }
  for (; next_ < first + count; ++next_) {
    const std::uint64_t at = next_own();
    const std::uint8_t* content = bytes_.from(at, group_->record_bytes);
    if (group_->apart_bytes > 0) {
      joined_.assign(content, content + group_->record_bytes);
      const std::uint8_t* const apart = apart_.from(next_ * group_->apart_bytes, group_->apart_bytes);
      joined_.insert(joined_.end(), apart, apart + group_->apart_bytes);
      content = joined_.data();
    }
    if (next_ >= first) record(content, next_);
    at_ = at + group_->record_bytes;
  }
}

}  // namespace spoolflow::recording
