#include <algorithm>
#include <mutex>
#include <stdexcept>

#include <fmt/format.h>

#include "spoolflow/recording/written_tables/hdf5_placed_file.hpp"
#include "spoolflow/recording/written_tables/table_writers.hpp"

namespace spoolflow::recording {
namespace {

constexpr hsize_t rows_of_a_chunk = 16384;

/// The library is used by one thread at a time.
std::mutex& turn() {
  static std::mutex mutex;
  return mutex;
}

hid_t checked(hid_t answer, std::string_view what) {
  if (answer < 0) throw std::runtime_error(fmt::format("the HDF5 library does not {}", what));
  return answer;
}

void put_text(hid_t object, const std::string& name, const std::string& text) {
  const Hdf5Handle type(checked(H5Tcopy(H5T_C_S1), "copy a type"), H5Tclose);
  H5Tset_size(type.id(), std::max<std::size_t>(1, text.size()));
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  const Hdf5Handle space(checked(H5Screate(H5S_SCALAR), "make a scalar"), H5Sclose);
  const Hdf5Handle attribute(H5Acreate2(object, name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  checked(attribute.id(), "take an attribute");
  checked(H5Awrite(attribute.id(), type.id(), text.empty() ? "\0" : text.data()), "write an attribute");
}

void put_words(hid_t object, const std::string& name, const std::vector<std::uint32_t>& words) {
  const hsize_t count = words.size();
  const Hdf5Handle space(checked(H5Screate_simple(1, &count, nullptr), "make a vector"), H5Sclose);
  const Hdf5Handle attribute(H5Acreate2(object, name.c_str(), H5T_STD_U32LE, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  checked(attribute.id(), "take an attribute");
  checked(H5Awrite(attribute.id(), H5T_NATIVE_UINT32, words.data()), "write an attribute");
}

Hdf5Handle new_column(hid_t file, const std::string& name, hid_t type) {
  const hsize_t none = 0, endless = H5S_UNLIMITED, chunk = rows_of_a_chunk;
  const Hdf5Handle space(checked(H5Screate_simple(1, &none, &endless), "make a vector"), H5Sclose);
  const Hdf5Handle made(checked(H5Pcreate(H5P_DATASET_CREATE), "make a list of properties"), H5Pclose);
  H5Pset_chunk(made.id(), 1, &chunk);
  H5Pset_obj_track_times(made.id(), false);  // the same numbers are the same bytes
  Hdf5Handle out(H5Dcreate2(file, name.c_str(), type, space.id(), H5P_DEFAULT, made.id(), H5P_DEFAULT), H5Dclose);
  checked(out.id(), "create a dataset");
  return out;
}

class Hdf5Writer final : public TableWriter {
 public:
  Hdf5Writer(TableHead head, TableOutput& output) : head_(std::move(head)), place_{&output.in_places()} {
    const std::lock_guard lock(turn());
    file_ = create_hdf5_file(place_);
    for (const auto& [key, value] : head_.notes) put_text(file_.id(), key, value);
    for (const NumberColumn& column : head_.numbers) {
      columns_.push_back(new_column(file_.id(), column.name, H5T_IEEE_F64LE));
      put_text(columns_.back().id(), "units", column.unit);
      put_text(columns_.back().id(), "long_name", column.meaning);
    }
    columns_.push_back(new_column(file_.id(), head_.flags, H5T_STD_U32LE));
    std::vector<std::uint32_t> masks;
    std::string meanings;
    for (const FlagName& flag : head_.flag_names) {
      masks.push_back(flag.bit);
      meanings += (meanings.empty() ? "" : " ") + flag.name;
    }
    put_words(columns_.back().id(), "flag_masks", masks);
    put_text(columns_.back().id(), "flag_meanings", meanings);
    report_failure();
  }

  ~Hdf5Writer() override {
    const std::lock_guard lock(turn());
    columns_.clear();
    file_ = {};
  }

  void write(const TableRows& rows) override {
    if (rows.count() == 0) return;
    const std::lock_guard lock(turn());
    for (std::size_t k = 0; k < head_.numbers.size(); ++k)
      append(columns_[k].id(), H5T_NATIVE_DOUBLE, rows.numbers[k].data(), rows.count());
    append(columns_.back().id(), H5T_NATIVE_UINT32, rows.flags.data(), rows.count());
    rows_ += rows.count();
    report_failure();
  }

  void finish() override {
    const std::lock_guard lock(turn());
    checked(H5Fflush(file_.id(), H5F_SCOPE_LOCAL), "write the file");
    columns_.clear();
    file_ = {};
    report_failure();
  }

 private:
  void append(hid_t column, hid_t type, const void* values, hsize_t count) const {
    const hsize_t from = rows_, to = rows_ + count;
    checked(H5Dset_extent(column, &to), "lengthen a dataset");
    const Hdf5Handle there(checked(H5Dget_space(column), "read a dataset's size"), H5Sclose);
    checked(H5Sselect_hyperslab(there.id(), H5S_SELECT_SET, &from, nullptr, &count, nullptr), "choose rows");
    const Hdf5Handle here(checked(H5Screate_simple(1, &count, nullptr), "make a vector"), H5Sclose);
    checked(H5Dwrite(column, type, here.id(), there.id(), H5P_DEFAULT, values), "write a dataset");
  }
  void report_failure() const {
    if (place_.failure) std::rethrow_exception(place_.failure);
  }

  TableHead head_;
  Hdf5Place place_;
  Hdf5Handle file_;
  std::vector<Hdf5Handle> columns_;
  hsize_t rows_ = 0;
};

}  // namespace

std::unique_ptr<TableWriter> hdf5_writer(TableHead head, TableOutput& output) {
  return std::make_unique<Hdf5Writer>(std::move(head), output);
}

}  // namespace spoolflow::recording
