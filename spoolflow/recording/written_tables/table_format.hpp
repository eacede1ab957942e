#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string_view>

namespace spoolflow::recording {

/// What a table can be written as.
enum class TableFormat { csv, parquet, hdf5, mat };

inline constexpr std::array all_table_formats{TableFormat::csv, TableFormat::parquet, TableFormat::hdf5,
                                              TableFormat::mat};

/// "csv", "parquet", "h5", "mat": also the suffix of its files.
[[nodiscard]] std::string_view suffix(TableFormat format);
/// By such a name, or "hdf5"; capitals are read as small letters. Nothing where no format has it.
[[nodiscard]] std::optional<TableFormat> table_format(std::string_view name);
/// By the file's suffix. CSV where the name has none or one that promises nothing; throws std::invalid_argument where
/// it promises another format (.xlsx, .tdms, .mf4), so that no file is other than its name says.
[[nodiscard]] TableFormat table_format_of(const std::filesystem::path& file);
/// For what is written as CSV alone: throws std::invalid_argument where the file's suffix promises another format.
void refuse_other_than_csv(const std::filesystem::path& file);

}  // namespace spoolflow::recording
