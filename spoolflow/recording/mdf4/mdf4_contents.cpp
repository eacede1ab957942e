#include "spoolflow/recording/mdf4/mdf4_contents.hpp"

#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::uint64_t identification_bytes = 64;
constexpr std::uint64_t longest_record = std::uint64_t{1} << 20U;
constexpr std::size_t most_mdf4_channels = 65536;

void check_version(const FileBytes& file) {
  std::array<std::uint8_t, identification_bytes> raw{};
  file.read(0, raw);
  const std::string& what = file.name();
  ByteReader bytes(raw, ByteOrder::lowest_first, what);
  const bool unfinished = bytes.text(8) == "UnFinMF ";
  const std::string_view version = bytes.text(8);
  if (version.empty() || version[0] != '4') {
    throw RecordingError(fmt::format(
        "{}: is an MDF file of version {}, where 4 is read; save it as MDF 4 (mf4) in the program that wrote it",
        file.name(), version.substr(0, version.find_first_of(std::string_view(" \0", 2)))));
  }
  if (unfinished) {
    throw RecordingError(
        fmt::format("{}: was not finished by the program that recorded it; finalise it (open and save it there), or "
                    "record it again",
                    file.name()));
  }
}

class Groups {
 public:
  explicit Groups(const FileBytes& file) : file_(file), declared_(file.name(), file.size()) {}

  Mdf4Contents read() {
    const Mdf4Block header = read_block(file_, identification_bytes, "##HD");
    for (std::uint64_t at = header.link(0); at != 0;) {
      const Mdf4Block block = taken(at, "##DG");
      data_group(block);
      at = block.link(0);
    }
    find_times();
    if (out_.groups.empty() && out_.unread.empty())
      note("", "no group of it holds records of numbers; record it again");
    return std::move(out_);
  }

 private:
  /// A block of a chain, which is refused where it is met again.
  Mdf4Block taken(std::uint64_t at, std::string_view id) {
    Mdf4Block out = read_block(file_, at, id);
    if (!seen_.insert(at).second) refuse_mdf4(out.what, "its links lead round in a circle");
    return out;
  }

  /// Groups by columns may have their time in another one, whose records theirs then are as many as.
  void find_times() {
    for (std::size_t g = 0; g < out_.groups.size(); ++g) {
      const Mdf4Group& group = out_.groups[g];
      const auto master = std::ranges::find(out_.groups, group.master, &Mdf4Group::at);
      const bool known = group.master != 0 && master != out_.groups.end();
      if (known && master->count != group.count) {
        refuse_mdf4(group.what(),
                    fmt::format("{} records, where the group that holds its time has {}", group.count, master->count));
      }
      out_.time_group.push_back(known ? static_cast<std::size_t>(master - out_.groups.begin()) : g);
    }
  }

  void data_group(const Mdf4Block& block) {
    const std::uint8_t number_bytes = block.reader().u8();
    if (number_bytes > 8) refuse_mdf4(block.what, fmt::format("record numbers of {} bytes", number_bytes));
    auto records = std::make_shared<Mdf4Records>(Mdf4Records{{file_, block.link(2), declared_},
                                                             {file_, block.link(2), declared_, Mdf4Part::invalid_apart},
                                                             number_bytes,
                                                             {},
                                                             {}});
    for (std::uint64_t at = block.link(1); at != 0;) {
      const Mdf4Block group = taken(at, "##CG");
      channel_group(group, records);
      at = group.link(0);
    }
    if (number_bytes == 0 && records->bytes.size() > 1) {
      refuse_mdf4(block.what, "several kinds of records, which no number distinguishes");
    }
  }

  void channel_group(const Mdf4Block& block, const std::shared_ptr<Mdf4Records>& records) {
    constexpr std::uint16_t of_any_length = 1, bus = 4, remote_master = 8;
    ByteReader bytes = block.reader();
    Mdf4Group group;
    group.records = records;
    group.at = block.head.at;
    group.number = bytes.u64();
    group.count = bytes.u64();
    const std::uint16_t flags = bytes.u16();
    bytes.skip(2 + 4);
    data_bytes_ = bytes.u32();
    const std::uint32_t invalid_bytes = bytes.u32();
    const bool by_columns = records->stream.by_columns();
    group.record_bytes = std::uint64_t{data_bytes_} + (by_columns ? 0 : invalid_bytes);
    if (by_columns && records->invalid.size() > 0) group.apart_bytes = invalid_bytes;
    if (std::uint64_t{data_bytes_} + invalid_bytes > longest_record)
      refuse_mdf4(block.what, fmt::format("records of {} bytes", std::uint64_t{data_bytes_} + invalid_bytes));
    if (!records->bytes.emplace(group.number, group.record_bytes).second) {
      refuse_mdf4(block.what, fmt::format("two kinds of records have the number {}", group.number));
    }
    records->of_any_length[group.number] = (flags & of_any_length) != 0;
    if ((flags & of_any_length) != 0) return;
    ++groups_;
    group.name = read_text(file_, block.link(2));
    if (group.name.empty()) group.name = fmt::format("group {}", groups_);
    if ((flags & bus) != 0) {
      note("", fmt::format("group '{}' holds messages of a bus, which are not read; export it with its signals (by the "
                           "bus's database)",
                           group.name));
      return;
    }
    constexpr std::size_t master_link = 6;
    if ((flags & remote_master) != 0) group.master = block.link(master_link);
    if (group.count > 0 && group.record_bytes + group.apart_bytes + records->number_bytes == 0) {
      note("", fmt::format("group '{}' has {} records without a byte, which are not read", group.name, group.count));
      return;
    }
    check_count(block, group);
    channels(group, block.link(1), "", 0);
    if (group.count > 0 && !group.channels.empty()) out_.groups.push_back(std::move(group));
  }

  void check_count(const Mdf4Block& block, const Mdf4Group& group) const {
    const auto check = [&](std::uint64_t each, std::uint64_t all, const char* of) {
      if (group.count == 0 || (each > 0 && group.count <= all / each)) return;
      refuse_mdf4(block.what, fmt::format("{} records of {} bytes in {} bytes of {}", group.count, each, all, of));
    };
    check(group.record_bytes + group.records->number_bytes, group.records->stream.size(), "data");
    if (group.apart_bytes > 0) check(group.apart_bytes, group.records->invalid.size(), "what is invalid");
  }

  /// The chain of channels from there on; `structure`: the names of what they are members of, each with a dot.
  void channels(Mdf4Group& group, std::uint64_t at, const std::string& structure, int depth) {
    constexpr int deepest = 8;
    while (at != 0) {
      const Mdf4Block block = taken(at, "##CN");
      if (++channels_ > most_mdf4_channels)
        refuse_mdf4(block.what, fmt::format("more than {} channels", most_mdf4_channels));
      const std::string name = structure + read_text(file_, block.link(2));
      const std::uint64_t inside = block.link(1);
      const bool members = inside != 0 && read_head(file_, inside).id == "##CN";
      if (members && depth < deepest) {
        channels(group, inside, name + ".", depth + 1);
      } else if (inside != 0) {
        note_channel(name, "an array");
      } else {
        channel(group, block, name);
      }
      at = block.link(0);
    }
  }

  void channel(Mdf4Group& group, const Mdf4Block& block, const std::string& name) {
    constexpr std::uint8_t fixed = 0, master = 2, virtual_master = 3, virtual_data = 6, time = 1;
    ByteReader bytes = block.reader();
    const std::uint8_t kind = bytes.u8(), measure = bytes.u8(), type = bytes.u8(), bit = bytes.u8();
    const std::uint32_t byte = bytes.u32(), bits = bytes.u32(), flags = bytes.u32(), invalid_bit = bytes.u32();
    Mdf4Channel out;
    out.name = name;
    const bool by_index = kind == virtual_master || kind == virtual_data;
    std::string why;
    if (by_index) {
      out.sample.by_index = true;
      out.sample.number.kind = StoredNumber::Kind::unsigned_whole;
    } else if (kind != fixed && kind != master) {
      why = "values of any length, or of another file";
    } else if (const auto sample = mdf4_sample(type, byte, bit, bits, why)) {
      out.sample = *sample;
      if (std::uint64_t{byte} + sample->span() > data_bytes_) {
        refuse_mdf4(block.what, fmt::format("{} bits at byte {} of records of {} bytes", bits, byte, data_bytes_));
      }
    }
    const std::uint64_t converted = block.link(4);
    if (why.empty() && converted != 0) {
      out.conversion = Mdf4Conversion(file_, converted);
      why = out.conversion.unread();
      out.unit = out.conversion.unit();
    }
    constexpr std::uint32_t all_invalid = 1, may_be_invalid = 2;
    if ((flags & all_invalid) != 0) why = "nothing but invalid samples";
    if (!why.empty()) return note_channel(name, why);
    if (block.link(6) != 0) out.unit = read_text(file_, block.link(6));
    if ((flags & may_be_invalid) != 0) invalid_from(group, block, invalid_bit, out.sample);
    out.is_time = (kind == master || kind == virtual_master) && measure == time;
    if (out.is_time && out.unit.empty()) out.unit = "s";
    group.channels.push_back(std::move(out));
  }

  /// The bits stand behind the record's data; by columns there may be none.
  void invalid_from(const Mdf4Group& group, const Mdf4Block& block, std::uint32_t bit, Mdf4Sample& sample) const {
    if (group.records->stream.by_columns() && group.apart_bytes == 0) return;
    if (std::uint64_t{data_bytes_} + bit / 8 >= group.record_bytes + group.apart_bytes) {
      refuse_mdf4(block.what, fmt::format("there is no bit {} that marks invalid samples", bit));
    }
    sample.invalid_bit = 8 * data_bytes_ + bit;
  }

  void note_channel(const std::string& name, const std::string& why) {
    note(name, fmt::format("channel '{}' holds {}, which is not read; write it as numbers in its unit", name, why));
  }
  void note(const std::string& channel, const std::string& what) { keep(out_.unread, {channel, what}); }

  const FileBytes& file_;
  DeclaredSize declared_;
  Mdf4Contents out_;
  std::set<std::uint64_t> seen_;
  std::uint32_t data_bytes_ = 0;  ///< of the group's records, before the bits of what is invalid
  std::size_t groups_ = 0, channels_ = 0;
};

}  // namespace

Mdf4Contents read_mdf4_contents(const FileBytes& file) {
  check_version(file);
  return Groups(file).read();
}

}  // namespace spoolflow::recording
