#include "spoolflow/recording/tdms/tdms_raw_index.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::uint32_t daqmx_numbers = 0x1269, daqmx_lines = 0x126A, daqmx_lines_too = 0x1369;
constexpr double rounding_of_shares = 1e-6;  // samples

[[noreturn]] void refuse(const std::string& what, const std::string& why) {
  throw RecordingError(fmt::format("{}: {}; it is damaged, copy or record it again", what, why));
}

void read_daqmx(TdmsRawIndex& out, ByteReader& bytes, bool lines, const std::string& what) {
  constexpr std::uint32_t most = 4096;
  const std::uint32_t scalers = bytes.u32();
  if (scalers > most) refuse(what, fmt::format("{} scalers of one channel", scalers));
  for (std::uint32_t k = 0; k < scalers; ++k) {
    TdmsRawIndex::Scaler scaler{bytes.u32(), bytes.u32(), bytes.u32(), -1};
    if (lines) {
      scaler.bit = static_cast<int>(scaler.byte % 8);
      scaler.byte /= 8;
    }
    bytes.skip(lines ? 5 : 8);  // sample format, number of the scale
    out.scalers.push_back(scaler);
  }
  const std::uint32_t widths = bytes.u32();
  if (widths == 0 || widths > most) refuse(what, fmt::format("{} buffers of DAQmx", widths));
  for (std::uint32_t k = 0; k < widths; ++k) out.widths.push_back(bytes.u32());
}

/// Nothing but the reason where the samples are no numbers.
std::string why_unread(const TdmsRawIndex& index) {
  if (index.of_daqmx()) {
    if (index.scalers.size() != 1) return fmt::format("{} DAQmx scalers at once", index.scalers.size());
    return stored_daqmx_number(index.scalers[0].type, ByteOrder::lowest_first) ? "" : "a type that is not known";
  }
  switch (index.type) {
    case TdmsType::text:
      return "text";
    case TdmsType::complex_single:
    case TdmsType::complex_real:
      return "complex numbers";
    case TdmsType::extended:
    case TdmsType::extended_with_unit:
      return "numbers of extended precision";
    default:
      return "";
  }
}

std::uint64_t bytes_of(const TdmsRawIndex& index) {
  return index.type == TdmsType::text ? index.text_bytes : index.count * bytes_of(index.type);
}

/// Buffers one behind the other, in each of them rows of all its channels.
void lay_out_daqmx(TdmsChunk& out, const std::vector<TdmsSource>& sources, const std::string& what) {
  const std::vector<std::uint32_t>& widths = sources.front().index.widths;
  std::vector<std::uint64_t> rows(widths.size()), begins(widths.size());
  for (const TdmsSource& source : sources) {
    if (source.index.widths != widths) refuse(what, "the widths of DAQmx' buffers differ from channel to channel");
    for (const TdmsRawIndex::Scaler& scaler : source.index.scalers) {
      if (scaler.buffer >= widths.size()) refuse(what, fmt::format("there is no buffer {} of DAQmx", scaler.buffer));
      rows[scaler.buffer] = std::max(rows[scaler.buffer], source.index.count);
    }
  }
  for (std::size_t k = 0; k < widths.size(); ++k) {
    begins[k] = out.bytes;
    out.bytes += rows[k] * widths[k];
  }
  for (std::size_t k = 0; k < sources.size(); ++k) {
    TdmsPart& part = out.parts[k];
    if (!part.unread.empty()) continue;
    const TdmsRawIndex::Scaler& scaler = sources[k].index.scalers.front();
    part.number = stored_daqmx_number(scaler.type, part.order);
    part.bit = scaler.bit;
    part.at = begins[scaler.buffer] + scaler.byte;
    part.stride = widths[scaler.buffer];
    if (scaler.byte > part.stride || part.number->bytes > part.stride - scaler.byte) {
      refuse(what, fmt::format("a number of {} bytes at byte {} of a row of {}", part.number->bytes, scaler.byte,
                               part.stride));
    }
  }
}

void lay_out_rows(TdmsChunk& out, const std::vector<TdmsSource>& sources, const std::string& what) {
  std::uint64_t width = 0;
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const TdmsRawIndex& index = sources[k].index;
    if (index.type == TdmsType::text) refuse(what, "texts are interleaved with numbers, which the format forbids");
    if (index.count != sources.front().index.count) refuse(what, "interleaved channels are not equally long");
    out.parts[k].at = width;
    width += bytes_of(index.type);
  }
  for (TdmsPart& part : out.parts) part.stride = width;
  out.bytes = width * sources.front().index.count;
}

/// Of channels one behind the other, of which the file's end cuts some off: the share of each that is there of all.
/// None where a channel has nothing.
void keep_in_all(TdmsChunk& chunk) {
  double share = 1;
  for (const TdmsPart& part : chunk.parts) {
    if (part.count == 0) continue;
    const std::uint64_t there = chunk.bytes > part.at ? (chunk.bytes - part.at) / part.stride : 0;
    share = std::min(share, static_cast<double>(there) / static_cast<double>(part.count));
  }
  for (TdmsPart& part : chunk.parts) {
    part.count = static_cast<std::uint64_t>(static_cast<double>(part.count) * share + rounding_of_shares);
  }
  if (std::ranges::all_of(chunk.parts, [](const TdmsPart& part) { return part.count == 0; })) chunk.parts.clear();
}

}  // namespace

const TdmsPart* TdmsChunk::part_of(std::size_t channel) const {
  const auto found = std::ranges::lower_bound(parts, channel, {}, &TdmsPart::channel);
  return found == parts.end() || found->channel != channel ? nullptr : &*found;
}

TdmsRawIndex read_raw_index(ByteReader& bytes, std::uint32_t head, std::uint64_t file_bytes, const std::string& what) {
  const bool lines = head == daqmx_lines || head == daqmx_lines_too;
  TdmsRawIndex out;
  out.type = static_cast<TdmsType>(bytes.u32());
  const std::uint32_t dimension = bytes.u32();
  if (dimension != 1) refuse(what, fmt::format("samples of {} dimensions, where 1 is allowed", dimension));
  out.count = bytes.u64();
  constexpr std::uint64_t most = std::uint64_t{1} << 40U, widest = std::uint64_t{1} << 20U;
  if (out.count > std::min(file_bytes, most)) {
    refuse(what, fmt::format("{} samples in a file of {} bytes", out.count, file_bytes));
  }
  if (lines || head == daqmx_numbers) {
    read_daqmx(out, bytes, lines, what);
    for (const std::uint32_t width : out.widths) {
      if (width > std::min(file_bytes, widest)) refuse(what, fmt::format("a row of {} bytes", width));
    }
  } else if (out.type == TdmsType::text) {
    out.text_bytes = bytes.u64();
    if (out.text_bytes > std::min(file_bytes, most)) refuse(what, fmt::format("{} bytes of text", out.text_bytes));
  } else if (bytes_of(out.type) == 0 && out.count > 0) {
    refuse(what, fmt::format("samples of type {:#x}, which is not known", static_cast<std::uint32_t>(out.type)));
  }
  return out;
}

TdmsChunk chunk_of(const std::vector<TdmsSource>& sources, bool interleaved, ByteOrder order, const std::string& what) {
  TdmsChunk out;
  if (sources.empty()) return out;
  for (const auto& [channel, index] : sources) {
    TdmsPart part{channel,
                  stored_number(index.type, order),
                  index.type == TdmsType::time,
                  -1,
                  order,
                  index.count,
                  0,
                  bytes_of(index.type),
                  why_unread(index)};
    if (!index.of_daqmx() && part.unread.empty() && index.count > 0 && !part.number && !part.is_time) {
      part.unread = "a type that is not known";
    }
    out.parts.push_back(std::move(part));
  }
  const auto of_daqmx = std::ranges::count_if(sources, [](const TdmsSource& one) { return one.index.of_daqmx(); });
  if (of_daqmx == static_cast<std::ptrdiff_t>(sources.size())) {
    lay_out_daqmx(out, sources, what);
  } else if (of_daqmx > 0) {
    refuse(what, "samples of DAQmx and others are mixed in one segment");
  } else if (interleaved) {
    lay_out_rows(out, sources, what);
  } else {
    for (std::size_t k = 0; k < sources.size(); ++k) {
      out.parts[k].at = out.bytes;
      out.bytes += bytes_of(sources[k].index);
    }
  }
  std::ranges::sort(out.parts, {}, &TdmsPart::channel);
  return out;
}

TdmsChunk shorter_chunk(const TdmsChunk& whole, std::uint64_t bytes, bool cut) {
  TdmsChunk out = whole;
  out.bytes = bytes;
  const std::uint64_t row = out.parts.empty() ? 0 : out.parts.front().stride;
  const bool in_rows = row > 0 && std::ranges::all_of(out.parts, [row](const TdmsPart& part) {
                         return part.stride == row && part.at < row;
                       });
  if (in_rows) {
    for (TdmsPart& part : out.parts) part.count = std::min(part.count, bytes / row);
    return out;
  }
  const bool known = std::ranges::none_of(out.parts, [](const TdmsPart& part) { return part.stride == 0; });
  const bool of_daqmx = std::ranges::any_of(
      out.parts, [&](const TdmsPart& part) { return part.number && part.stride != part.number->bytes; });
  if (!known || of_daqmx) {
    out.parts.clear();
    return out;
  }
  if (cut) {
    keep_in_all(out);
    return out;
  }
  std::vector<TdmsPart*> in_file;
  for (TdmsPart& part : out.parts) in_file.push_back(&part);
  std::ranges::stable_sort(in_file, {}, &TdmsPart::at);
  std::uint64_t at = 0;
  for (TdmsPart* const part : in_file) {
    const double share = static_cast<double>(bytes) / static_cast<double>(whole.bytes);
    part->count = static_cast<std::uint64_t>(static_cast<double>(part->count) * share + rounding_of_shares);
    part->at = at;
    at += part->count * part->stride;
  }
  if (at > bytes) out.parts.clear();
  return out;
}

}  // namespace spoolflow::recording
