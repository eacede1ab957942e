#include "spoolflow/recording/files/hdf5_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/clock_time.hpp"
#include "spoolflow/recording/files/declared_size.hpp"
#include "spoolflow/recording/files/hdf5_attributes.hpp"
#include "spoolflow/recording/files/hdf5_handle.hpp"
#include "spoolflow/recording/files/hdf5_unread.hpp"
#include "spoolflow/recording/files/matrix_names.hpp"
#include "spoolflow/recording/files/time_name.hpp"
#include "spoolflow/recording/files/vector_table.hpp"
#include "spoolflow/units/unit.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t chunk_cache_bytes = std::size_t{16} << 20;  // a chunk is unpacked once, not once a block

class Hdf5Table final : public VectorTable {
 public:
  explicit Hdf5Table(const std::filesystem::path& path)
      : VectorTable(path.string()), declared_(path.string(), std::filesystem::file_size(path)) {
    silence_hdf5();
    file_handle_ = Hdf5Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (!file_handle_.valid()) {
      throw RecordingError(
          fmt::format("{}: is damaged or cut short: HDF5 cannot open it; copy or record it again", file()));
    }
    refuse_other_files(file_handle_.id(), file());
    const bool listed =
        H5Ovisit2(file_handle_.id(), H5_INDEX_NAME, H5_ITER_INC, &Hdf5Table::visit, this, H5O_INFO_BASIC) >= 0;
    if (failure_) std::rethrow_exception(failure_);
    if (!listed) {
      throw RecordingError(fmt::format(
          "{}: is damaged or cut short: its table of contents cannot be read; copy or record it again", file()));
    }
    add_listed();
  }

  [[nodiscard]] std::vector<UnreadPart> unread() const override { return unread_; }

  void copy(std::size_t column, std::uint64_t first, std::size_t count, double* out) override {
    const Source& source = sources_[column];
    const Dataset& from = opened(column, first);
    read_stored(source, from, first, count, out);
    for (const double fill : from.fills) std::replace(out, out + count, fill, std::numeric_limits<double>::quiet_NaN());
    if (from.scale == 1.0 && from.offset == 0.0) return;
    for (std::size_t k = 0; k < count; ++k) out[k] = from.scale * out[k] + from.offset;
  }

 private:
  struct Source {
    std::string path;
    int rank;
    bool is_row;
    std::uint64_t index;
    double later = 0;  ///< of times: by how much their group begins after the first one, in their unit
  };
  struct Dataset {
    Hdf5Handle dataset;
    Hdf5Handle space;
    double scale = 1.0;
    double offset = 0.0;
    std::vector<double> fills{};  ///< numbers that stand for a missing sample, as stored
  };
  struct Listed {
    Vector vector;
    std::optional<ClockTime> start;  ///< of the waveform, or of the group that the times count in
  };

  void read_stored(const Source& source, const Dataset& from, std::uint64_t first, std::size_t count, double* out) {
    // A vector lies along the first dimension, or as a row along the second.
    const std::array<hsize_t, 2> start{source.is_row ? source.index : first, source.is_row ? first : source.index};
    const std::array<hsize_t, 2> size{source.is_row ? 1 : count, source.is_row ? count : 1};
    const hsize_t in_memory = count;
    const Hdf5Handle memory(H5Screate_simple(1, &in_memory, nullptr), H5Sclose);
    if (!from.space.valid() || !memory.valid() ||
        H5Sselect_hyperslab(from.space.id(), H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr) < 0 ||
        H5Dread(from.dataset.id(), H5T_NATIVE_DOUBLE, memory.id(), from.space.id(), H5P_DEFAULT, out) < 0) {
      refuse_damaged(source, first);
    }
  }

  // `info` is what H5Ovisit2 gives: H5O_info_t, which HDF5 1.12 and later call H5O_info1_t.
  static herr_t visit(hid_t file, const char* name, const auto* info, void* table) {
    if (info->type != H5O_TYPE_DATASET) return 0;
    try {
      static_cast<Hdf5Table*>(table)->list(file, name);
    } catch (...) {  // no exception may pass through the library
      static_cast<Hdf5Table*>(table)->failure_ = std::current_exception();
      return -1;
    }
    return 0;
  }

  void list(hid_t file_id, const std::string& path) {
    const Hdf5Handle dataset(H5Dopen2(file_id, path.c_str(), H5P_DEFAULT), H5Dclose);
    if (std::string why = why_unread(dataset.id(), path); !why.empty()) {
      keep(unread_, {path, std::move(why)});
      return;
    }
    const Hdf5Handle type(H5Dget_type(dataset.id()), H5Tclose);
    const Hdf5Handle space(H5Dget_space(dataset.id()), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.id());
    std::array<hsize_t, 2> size{1, 1};
    H5Sget_simple_extent_dims(space.id(), size.data(), nullptr);
    declared_.add(path, size[0], size[1], H5Tget_size(type.id()));
    std::string unit = text_attribute(dataset.id(), "unit");
    if (unit.empty()) unit = text_attribute(dataset.id(), "units");
    FileColumn column{path, path.substr(path.rfind('/') + 1), unit};
    // Of waveforms from LabVIEW and TDMS files, in seconds.
    const double step_s = number_attribute(dataset.id(), "wf_increment", 0.0);
    if (step_s > 0 && std::isfinite(step_s)) {
      const double begin_s = number_attribute(dataset.id(), "wf_start_offset", 0.0);
      if (std::isfinite(begin_s)) column.wave = EvenTimes(begin_s, step_s);
    }
    column.unapplied = unapplied_attributes(dataset.id(), path);
    const std::optional<ClockTime> start = step_s > 0           ? start_attribute(dataset.id(), "wf_start_time")
                                           : named_time(column) ? start_of_group(file_id, path)
                                                                : std::nullopt;
    if (start && (!origin_ || start->since(*origin_) < 0)) origin_ = start;
    for (MatrixPart& part : matrix_parts(column, size[0], size[1])) {
      sources_.push_back({path, rank, part.is_row, part.index});
      listed_.push_back({std::move(part.vector), start});
    }
  }

  /// The times of all waveforms and groups count from the earliest instant that one of them states.
  void add_listed() {
    for (std::size_t k = 0; k < listed_.size(); ++k) {
      auto& [vector, start] = listed_[k];
      if (start && vector.column.wave.empty()) {
        const auto unit = units::unit_named(unit_of_time(vector.column));
        sources_[k].later = start->since(*origin_) / (unit ? unit->factor : 1);
      } else if (start) {
        const EvenStretch stated = vector.column.wave.stretches().front();
        vector.column.wave = EvenTimes(stated.begin_s + start->since(*origin_), stated.step_s);
      }
      add(std::move(vector));
    }
    listed_.clear();
  }

  [[noreturn]] void refuse_damaged(const Source& source, std::uint64_t first) const {
    throw RecordingError(
        fmt::format("{}: dataset '{}' is damaged or cut short: it cannot be read from sample {} on; "
                    "copy or record it again",
                    file(), source.path, first + 1));
  }

  const Dataset& opened(std::size_t column, std::uint64_t first) {
    Dataset& out = datasets_[column];
    if (out.dataset.valid()) return out;
    const Source& source = sources_[column];
    const Hdf5Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
    H5Pset_chunk_cache(access.id(), H5D_CHUNK_CACHE_NSLOTS_DEFAULT, chunk_cache_bytes, H5D_CHUNK_CACHE_W0_DEFAULT);
    out.dataset = Hdf5Handle(H5Dopen2(file_handle_.id(), source.path.c_str(), access.id()), H5Dclose);
    if (!out.dataset.valid()) refuse_damaged(source, first);
    out.space = Hdf5Handle(H5Dget_space(out.dataset.id()), H5Sclose);
    out.scale = number_attribute(out.dataset.id(), "scale_factor", 1.0);
    out.offset = number_attribute(out.dataset.id(), "add_offset", 0.0);
    for (const char* const name : {"_FillValue", "missing_value"}) {
      if (const auto fill = optional_number_attribute(out.dataset.id(), name)) out.fills.push_back(*fill);
    }
    if (source.later > 0 && counts_from_its_start(column, out)) out.offset += source.later;
    return out;
  }

  /// Times that begin elsewhere than at 0 may count from another instant than their group's start.
  bool counts_from_its_start(std::size_t column, const Dataset& from) {
    std::array<double, 2> times{};
    if (length(column) < times.size()) return false;
    read_stored(sources_[column], from, 0, times.size(), times.data());
    return std::abs(times[0]) <= std::abs(times[1] - times[0]);
  }

  Hdf5Handle file_handle_;
  std::vector<Source> sources_;
  std::map<std::size_t, Dataset> datasets_;  ///< of the chosen columns
  std::vector<UnreadPart> unread_;
  std::vector<Listed> listed_;       ///< one a column
  std::optional<ClockTime> origin_;  ///< the earliest start of them
  DeclaredSize declared_;
  std::exception_ptr failure_;  ///< of list()
};

}  // namespace

std::unique_ptr<VectorTable> open_hdf5_table(const std::filesystem::path& file) {
  return std::make_unique<Hdf5Table>(file);
}

}  // namespace spoolflow::recording
