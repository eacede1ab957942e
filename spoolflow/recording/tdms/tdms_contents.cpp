#include "spoolflow/recording/tdms/tdms_contents.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/tdms/tdms_raw_index.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::uint64_t lead_in_bytes = 28;
constexpr std::uint64_t unfinished = ~std::uint64_t{0};
constexpr std::uint64_t longest_metadata = std::uint64_t{64} << 20U;
constexpr std::size_t most_tdms_channels = 65536;

/// What a segment holds, as its lead-in says.
struct LeadIn {
  static constexpr std::uint32_t has_metadata = 1U << 1U, new_objects = 1U << 2U, has_samples = 1U << 3U,
                                 interleaved = 1U << 5U, big_endian = 1U << 6U;
  std::uint32_t contents = 0;
  std::uint64_t next = 0, samples = 0;  ///< bytes behind the lead-in

  [[nodiscard]] bool is(std::uint32_t flag) const { return (contents & flag) != 0; }
  [[nodiscard]] ByteOrder order() const { return is(big_endian) ? ByteOrder::highest_first : ByteOrder::lowest_first; }
};

/// Names in quotes, a quote within one written twice: /'group'/'it''s a name'. Nothing where it is written otherwise.
std::optional<std::vector<std::string>> names_of(const std::string& path) {
  std::vector<std::string> out;
  if (path == "/") return out;
  for (std::size_t at = 0; at < path.size();) {
    if (path.compare(at, 2, "/'") != 0) return std::nullopt;
    out.emplace_back();
    for (at += 2;; ++at) {
      if (at >= path.size()) return std::nullopt;
      if (path[at] == '\'' && path.compare(at, 2, "''") != 0) break;
      if (path[at] == '\'') ++at;
      out.back() += path[at];
    }
    ++at;
  }
  return out;
}

/// The segments one after the other; what one leaves out is as in the one before.
class Segments {
 public:
  explicit Segments(const FileBytes& file) : file_(file) {}

  TdmsContents read() {
    std::uint64_t at = 0;
    while (file_.size() - at >= lead_in_bytes) at = segment(at);
    if (at < file_.size()) {
      lose(fmt::format("{} bytes at its end", file_.size() - at));
    }
    return std::move(out_);
  }

 private:
  /// Returns where the next one begins.
  std::uint64_t segment(std::uint64_t at) {
    segment_ = at;
    what_ = fmt::format("{}: the segment at byte {}", file_.name(), at);
    if (begun_ && is_blank(at)) {
      lose(fmt::format("whatever was to stand in the last {} bytes, which begin with zeros", file_.size() - at));
      return file_.size();
    }
    const LeadIn lead = lead_in(at);
    const std::uint64_t begin = at + lead_in_bytes;
    const std::uint64_t room = file_.size() - begin;
    const bool cut = lead.next > room;
    if (lead.samples > std::min(lead.next, room)) {
      if (!cut) refuse(fmt::format("its samples begin behind its end, {} bytes on", lead.samples));
      lose("the metadata of its last segment");
      return file_.size();
    }
    if (lead.is(LeadIn::has_metadata)) {
      metadata(begin, lead);
    } else if (!begun_) {
      refuse("the first one has no metadata");
    }
    const std::uint64_t end = cut ? file_.size() : begin + lead.next;
    if (lead.is(LeadIn::has_samples)) samples(begin + lead.samples, end, cut);
    if (cut)
      lose(lead.next == unfinished ? "the end of its last segment, which was never finished"
                                   : fmt::format("the end of its last segment, {} bytes", lead.next - room));
    return end;
  }

  /// Where the machine went down, the file may have got its length but not its content.
  [[nodiscard]] bool is_blank(std::uint64_t at) const {
    std::array<std::uint8_t, lead_in_bytes> bytes{};
    file_.read(at, bytes);
    return std::ranges::all_of(bytes, [](std::uint8_t byte) { return byte == 0; });
  }

  LeadIn lead_in(std::uint64_t at) {
    std::array<std::uint8_t, lead_in_bytes> bytes{};
    file_.read(at, bytes);
    if (!std::equal(bytes.begin(), bytes.begin() + 4, "TDSm")) refuse("it does not begin with TDSm");
    LeadIn out;
    const std::span<const std::uint8_t> all(bytes);
    out.contents = ByteReader(all.subspan(4), ByteOrder::lowest_first, what_).u32();
    ByteReader rest(all.subspan(8), out.order(), what_);
    const std::uint32_t version = rest.u32();
    if (version != 4712 && version != 4713) {
      refuse(fmt::format("it is of version {}, where 4712 and 4713 are known", version));
    }
    out.next = rest.u64();
    out.samples = rest.u64();
    return out;
  }

  void metadata(std::uint64_t begin, const LeadIn& lead) {
    if (lead.samples > longest_metadata) refuse(fmt::format("{} bytes of metadata", lead.samples));
    std::vector<std::uint8_t> content(static_cast<std::size_t>(lead.samples));
    file_.read(begin, content);
    ByteReader bytes(content, lead.order(), what_);
    std::vector<std::size_t> before;
    const bool new_list = lead.is(LeadIn::new_objects);
    if (new_list) {
      for (const TdmsSource& source : sources_) {
        before.push_back(source.channel);
        present_[source.channel] = false;
      }
      sources_.clear();
    }
    begun_ = true;
    listed_ = false;
    for (std::uint32_t left = bytes.u32(); left > 0; --left) object(bytes, lead.order());
    if (new_list) listed_ = !std::ranges::equal(before, sources_, {}, {}, &TdmsSource::channel);
    if (chunk_ && order_ == lead.order() && interleaved_ == lead.is(LeadIn::interleaved) && !changed_ && !listed_)
      return;
    order_ = lead.order();
    interleaved_ = lead.is(LeadIn::interleaved);
    changed_ = false;
    chunk_ = std::make_shared<const TdmsChunk>(chunk_of(sources_, interleaved_, order_, what_));
  }

  void object(ByteReader& bytes, ByteOrder order) {
    const std::string path(bytes.text(bytes.u32()));
    const auto names = names_of(path);
    if (!names || names->size() > 2) refuse(fmt::format("'{}' is no path of a group or channel", path));
    constexpr std::uint32_t none = 0xFFFFFFFF, as_before = 0;
    const std::uint32_t head = bytes.u32();
    if (names->size() == 2) {
      const std::size_t channel = channel_of(path, *names);
      if (head == none) {
        leave_out(channel);
      } else if (head != as_before) {
        TdmsRawIndex index = read_raw_index(bytes, head, file_.size(), what_);
        changed_ = changed_ || last_[channel] != index;
        last_[channel] = std::move(index);
        put_in(channel);
      } else if (!last_[channel]) {
        refuse(fmt::format("'{}' is said to be as before, but was not there before", path));
      } else {
        put_in(channel);
      }
    } else if (head != none && head != as_before) {
      refuse(fmt::format("'{}' is no channel, but is said to have samples", path));
    }
    TdmsProperties& said = out_.properties[path];
    said.read(bytes, order, what_);
    if (names->size() != 2) return;
    TdmsChannel& channel = out_.channels[channel_of(path, *names)];
    note_wave(channel, said);
    if (const std::string* const unit = said.text("unit_string")) channel.said_unit = *unit;
  }

  /// What the properties say of the samples to come.
  static void note_wave(TdmsChannel& channel, const TdmsProperties& said) {
    const double* const step = said.number("wf_increment");
    if (step == nullptr || !(*step > 0) || !std::isfinite(*step)) return;
    const double* const offset = said.number("wf_start_offset");
    const TdmsTime* const start = said.time("wf_start_time");
    TdmsWave wave{channel.samples, {}, 0, *step};
    if (offset != nullptr && std::isfinite(*offset)) wave.offset_s = *offset;
    if (start != nullptr && start->second > 0) wave.start = *start;
    if (!channel.waves.empty() && channel.waves.back().says_the_same(wave)) return;
    if (!channel.waves.empty() && channel.waves.back().first == wave.first) channel.waves.pop_back();
    channel.waves.push_back(wave);
  }

  void leave_out(std::size_t channel) {
    if (!present_[channel]) return;
    std::erase_if(sources_, [channel](const TdmsSource& source) { return source.channel == channel; });
    present_[channel] = false;
    listed_ = true;
  }

  void put_in(std::size_t channel) {
    if (present_[channel]) {
      if (changed_) std::ranges::find(sources_, channel, &TdmsSource::channel)->index = *last_[channel];
      return;
    }
    sources_.push_back({channel, *last_[channel]});
    present_[channel] = true;
    listed_ = true;
  }

  std::size_t channel_of(const std::string& path, const std::vector<std::string>& names) {
    const auto [entry, is_new] = channels_.try_emplace(path, out_.channels.size());
    if (is_new) {
      if (out_.channels.size() == most_tdms_channels) refuse(fmt::format("more than {} channels", most_tdms_channels));
      out_.channels.push_back({names[0], names[1], path});
      last_.emplace_back();
      present_.push_back(false);
    }
    return entry->second;
  }

  void samples(std::uint64_t begin, std::uint64_t end, bool cut) {
    if (!chunk_ || chunk_->bytes == 0 || end <= begin) return;
    const std::uint64_t chunks = (end - begin) / chunk_->bytes, rest = (end - begin) % chunk_->bytes;
    if (chunks > 0) add({chunk_, begin, chunks});
    if (rest == 0) return;
    const auto shorter = std::make_shared<const TdmsChunk>(shorter_chunk(*chunk_, rest, cut));
    if (shorter->parts.empty()) {
      lose(fmt::format("the end of its last segment, of which {} bytes are there, and not of all channels", rest));
    } else {
      add({shorter, begin + chunks * chunk_->bytes, 1});
    }
  }

  void add(const TdmsRun& run) {
    for (const TdmsPart& part : run.chunk->parts) {
      TdmsChannel& channel = out_.channels[part.channel];
      if (part.count == 0) continue;
      channel.samples += part.count * run.chunks;
      if (channel.unread.empty()) channel.unread = part.unread;
      if (channel.unit.empty()) channel.unit = channel.said_unit;
      if (channel.unit != channel.said_unit && channel.unread.empty()) {
        channel.unread = fmt::format("samples in {}, and in {} from the segment at byte {} on", channel.unit,
                                     channel.said_unit, segment_);
      }
      if (channel.samples > part.count * run.chunks && channel.of_time != part.is_time) {
        channel.unread = "times and numbers mixed";
      }
      channel.of_time = part.is_time;
    }
    out_.runs.push_back(run);
    out_.runs.back().segment = segment_;
  }

  void lose(const std::string& what) {
    if (out_.lost.empty()) out_.lost = what;
  }
  [[noreturn]] void refuse(const std::string& why) const {
    throw RecordingError(fmt::format("{}: {}; it is damaged, copy or record it again", what_, why));
  }

  const FileBytes& file_;
  TdmsContents out_;
  std::string what_;
  std::uint64_t segment_ = 0;                      ///< byte at which the one at hand begins
  std::map<std::string, std::size_t> channels_;    ///< by path
  std::vector<std::optional<TdmsRawIndex>> last_;  ///< of each channel
  std::vector<TdmsSource> sources_;                ///< of the segment at hand
  std::vector<bool> present_;                      ///< whether each channel is among them
  std::shared_ptr<const TdmsChunk> chunk_;         ///< of sources_
  ByteOrder order_ = ByteOrder::lowest_first;      ///< of chunk_
  bool interleaved_ = false, begun_ = false;
  bool changed_ = false;  ///< an index of sources_ since chunk_ was made
  bool listed_ = false;   ///< sources_ are others since chunk_ was made
};

}  // namespace

const TdmsProperties& TdmsContents::of(const std::string& path) const {
  static const TdmsProperties none;
  const auto found = properties.find(path);
  return found == properties.end() ? none : found->second;
}

TdmsContents read_tdms_contents(const FileBytes& file) {
  return Segments(file).read();
}

}  // namespace spoolflow::recording
