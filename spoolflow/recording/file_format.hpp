#pragma once
/// File formats, recognised by how a file begins.
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace spoolflow::recording {

enum class FileFormat : std::uint8_t { csv, mat, hdf5, tdms, mdf4, xlsx };
[[nodiscard]] std::string_view name(FileFormat format);

/// Bytes that are needed to recognise it.
inline constexpr std::size_t format_bytes = 4096;

/// `file` is for messages, and its ending for the one format without a mark of its own (MATLAB version 4). Throws
/// RecordingError for formats that are known but not read (old or protected Excel workbooks, compressed files), saying
/// what to do.
[[nodiscard]] FileFormat format_of(std::string_view beginning, const std::filesystem::path& file);

}  // namespace spoolflow::recording
