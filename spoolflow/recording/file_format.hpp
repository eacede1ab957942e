#pragma once
/// File formats, recognised by how a file begins.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace spoolflow::recording {

enum class FileFormat : std::uint8_t { csv, mat, hdf5, tdms, mdf4, xlsx };
[[nodiscard]] std::string_view name(FileFormat format);

/// Bytes that are needed to recognise it.
inline constexpr std::size_t format_bytes = 4096;

/// What a binary format's ending says (.tdms), whatever the file holds; nothing for the endings of text and of others.
[[nodiscard]] std::optional<FileFormat> format_by_ending(const std::filesystem::path& file);

/// `file` is for messages, and its ending for what begins with no format's mark: MATLAB version 4, which has none.
/// Throws RecordingError, saying what to do, for formats that are known but not read (old or protected Excel workbooks,
/// compressed files), and for bytes that are neither text nor what the ending says: a damaged beginning.
[[nodiscard]] FileFormat format_of(std::string_view beginning, const std::filesystem::path& file);

}  // namespace spoolflow::recording
