#include "spoolflow/recording/mdf4/mdf4_table.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/recording/mdf4/mdf4_contents.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::uint64_t bytes_at_once = std::uint64_t{1} << 18U;
constexpr std::uint64_t length_bytes = 4;

std::uint64_t whole(const std::uint8_t* from, std::uint64_t bytes) {
  std::uint64_t out = 0;
  for (std::uint64_t k = bytes; k-- > 0;) out = out << 8U | from[k];
  return out;
}

/// A stream's bytes, as they are asked for.
class Mdf4Bytes {
 public:
  /// `of`: for messages.
  explicit Mdf4Bytes(Mdf4Stream& stream, std::string of) : stream_(&stream), of_(std::move(of)) {}
  /// Those from `at` on, until the next call. Throws RecordingError where there are fewer.
  const std::uint8_t* from(std::uint64_t at, std::uint64_t count) {
    if (at < begin_ || at + count > begin_ + buffer_.size()) {
      if (at > stream_->size() || count > stream_->size() - at) refuse_mdf4(of_, "its records end too soon");
      buffer_.resize(static_cast<std::size_t>(std::min(stream_->size() - at, std::max(bytes_at_once, count))));
      begin_ = at;
      stream_->read(at, buffer_);
    }
    return buffer_.data() + (at - begin_);
  }

 private:
  Mdf4Stream* stream_;
  std::string of_;
  std::vector<std::uint8_t> buffer_{};
  std::uint64_t begin_ = 0;  ///< byte of the stream with which the buffer begins
};

/// The records of one group from the first to the last, a stretch after the other.
class Mdf4Walk {
 public:
  /// `group` must outlive it.
  explicit Mdf4Walk(const Mdf4Group& group)
      : group_(&group), bytes_(group.records->stream, group.what()), apart_(group.records->invalid, group.what()) {}

  /// Shows each of `count` records from `first` on, without its number but with what of it is kept apart, with its
  /// index. Forward it goes on from where it is; back it starts again. Throws RecordingError where the records end too
  /// soon.
  void show(std::uint64_t first, std::size_t count,
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

 private:
  /// Of several kinds: where the next record of this one begins, behind its number.
  std::uint64_t next_own() {
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

  const Mdf4Group* group_;
  std::uint64_t at_ = 0;    ///< byte of the stream, behind record next_ - 1
  std::uint64_t next_ = 0;  ///< index of the record that comes next
  Mdf4Bytes bytes_, apart_;
  std::vector<std::uint8_t> joined_{};  ///< a record whose parts stand in two streams
};

class Mdf4Table final : public VectorTable {
 public:
  explicit Mdf4Table(const std::filesystem::path& path)
      : VectorTable(path.string()), bytes_(path), contents_(read_mdf4_contents(bytes_)) {
    std::set<std::string> names;
    for (std::size_t g = 0; g < contents_.groups.size(); ++g) {
      if (contents_.time_group[g] != g) continue;
      std::string& name = contents_.groups[g].name;
      if (!names.insert(name).second) names.insert(name = fmt::format("{} #{}", name, g + 1));
    }
    for (std::size_t g = 0; g < contents_.groups.size(); ++g) {
      const Mdf4Group& group = contents_.groups[g];
      const std::string& timed = contents_.groups[contents_.time_group[g]].name;
      for (std::size_t c = 0; c < group.channels.size(); ++c) {
        const Mdf4Channel& channel = group.channels[c];
        FileColumn column{names.size() == 1 ? channel.name : timed + "/" + channel.name,
                          channel.is_time ? "time" : channel.name, channel.unit};
        add({std::move(column), group.count});
        sources_.push_back({g, c});
      }
    }
  }

  [[nodiscard]] std::vector<UnreadPart> unread() const override { return contents_.unread; }

  void copy(std::size_t column, std::uint64_t first, std::size_t count, double* out) override {
    if (first != first_ || count != count_) fill(first, count);
    std::ranges::copy(window_.at(column), out);
  }

 protected:
  void chosen(const std::vector<std::size_t>& columns) override {
    for (const std::size_t column : columns) {
      window_[column];
      const std::size_t group = sources_[column].group;
      walks_.try_emplace(group, contents_.groups[group]);
    }
  }

 private:
  struct Source {
    std::size_t group, channel;
  };

  [[nodiscard]] const Mdf4Channel& channel(std::size_t column) const {
    return contents_.groups[sources_[column].group].channels[sources_[column].channel];
  }

  /// Reads those samples of all chosen columns, each record once.
  void fill(std::uint64_t first, std::size_t count) {
    first_ = first, count_ = 0;  // nothing, should the reading fail
    for (auto& [group, walk] : walks_) {
      std::vector<std::pair<const Mdf4Sample*, double*>> wanted;
      for (auto& [column, values] : window_) {
        if (sources_[column].group != group) continue;
        values.resize(count);
        wanted.emplace_back(&channel(column).sample, values.data());
      }
      walk.show(first, count, [&](const std::uint8_t* record, std::uint64_t index) {
        for (const auto& [sample, out] : wanted) out[index - first] = sample->read(record, index);
      });
    }
    for (auto& [column, values] : window_) {
      const bool whole = channel(column).sample.number.kind != StoredNumber::Kind::real;
      channel(column).conversion.apply(values.data(), values.size(), whole);
    }
    count_ = count;
  }

  FileBytes bytes_;
  Mdf4Contents contents_;
  std::vector<Source> sources_;                        ///< one a column
  std::map<std::size_t, Mdf4Walk> walks_;              ///< of the groups of the chosen columns
  std::map<std::size_t, std::vector<double>> window_;  ///< the samples at hand of each chosen column
  std::uint64_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace

std::unique_ptr<VectorTable> open_mdf4_table(const std::filesystem::path& file) {
  return std::make_unique<Mdf4Table>(file);
}

}  // namespace spoolflow::recording
