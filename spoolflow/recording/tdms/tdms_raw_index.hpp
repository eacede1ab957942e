#pragma once
/// What the metadata of a TDMS segment says about the samples of one object.
#include <cstdint>
#include <string>
#include <vector>

#include "spoolflow/recording/tdms/tdms_layout.hpp"
#include "spoolflow/recording/tdms/tdms_type.hpp"

namespace spoolflow::recording {

struct TdmsRawIndex {
  /// Of DAQmx: which number of a buffer's row a sample is.
  struct Scaler {
    std::uint32_t type, buffer, byte;
    int bit;  ///< of digital lines; -1: the whole number

    bool operator==(const Scaler&) const = default;
  };
  TdmsType type = TdmsType::nothing;
  std::uint64_t count = 0;       ///< samples in a chunk
  std::uint64_t text_bytes = 0;  ///< of all texts in a chunk
  std::vector<Scaler> scalers{};
  std::vector<std::uint32_t> widths{};  ///< bytes of a row of each of DAQmx' buffers; empty of other samples

  [[nodiscard]] bool of_daqmx() const { return !widths.empty(); }
  bool operator==(const TdmsRawIndex&) const = default;
};

/// `head`: the four bytes before, neither "none" nor "as before". `file_bytes` bounds what is accepted. `what`: whose
/// it is, for messages. Throws RecordingError.
[[nodiscard]] TdmsRawIndex read_raw_index(ByteReader& bytes, std::uint32_t head, std::uint64_t file_bytes,
                                          const std::string& what);

/// An object that has samples in a chunk.
struct TdmsSource {
  std::size_t channel;
  TdmsRawIndex index;
};

/// The chunk of these objects in the order of the metadata. Throws RecordingError where they do not go together.
[[nodiscard]] TdmsChunk chunk_of(const std::vector<TdmsSource>& sources, bool interleaved, ByteOrder order,
                                 const std::string& what);

/// The last chunk of a segment, of which only `bytes` are there. Rows of all channels are kept as far as they are
/// whole. Of channels one behind the other all are shorter by the same share; where the file was `cut`, as long as the
/// one of which the least is there: none where one has nothing.
[[nodiscard]] TdmsChunk shorter_chunk(const TdmsChunk& whole, std::uint64_t bytes, bool cut);

}  // namespace spoolflow::recording
