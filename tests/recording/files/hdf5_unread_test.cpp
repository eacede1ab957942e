/// Datasets that are not read: what is said of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include "spoolflow/recording/reader.hpp"
#include "tests/recording/refusal.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr hsize_t chunk_samples = 4;

/// A file with one dataset, for whose making HDF5's own interface is at hand.
class OneDataset {
 public:
  OneDataset() : file_("run.h5") { id_ = H5Fcreate(file_.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT); }
  ~OneDataset() { close(); }
  OneDataset(const OneDataset&) = delete;
  OneDataset& operator=(const OneDataset&) = delete;

  void make(const char* name, hid_t type, const std::vector<hsize_t>& size) const {
    const hid_t space =
        size.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr);
    H5Dclose(H5Dcreate2(id_, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    H5Sclose(space);
  }
  /// A chunk whose bytes went through that filter, or as they are where `left_out`.
  void make_filtered(const char* name, H5Z_filter_t filter, bool left_out) const {
    const hid_t made = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(1, &chunk_samples, nullptr);
    H5Pset_chunk(made, 1, &chunk_samples);
    H5Pset_filter(made, filter, H5Z_FLAG_OPTIONAL, 0, nullptr);
    const hid_t data = H5Dcreate2(id_, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, made, H5P_DEFAULT);
    const std::array<double, chunk_samples> values{0.1, 0.2, 0.3, 0.4};
    const hsize_t first = 0;
    H5Dwrite_chunk(data, H5P_DEFAULT, left_out ? 1 : 0, &first, left_out ? sizeof values : 9, values.data());
    H5Dclose(data), H5Sclose(space), H5Pclose(made);
  }
  std::vector<std::string> unread() {
    close();
    return contents_of(file_.path()).unread;
  }
  const std::filesystem::path& close() {
    if (id_ >= 0) H5Fclose(id_);
    id_ = -1;
    return file_.path();
  }

 private:
  TemporaryFile file_;
  hid_t id_ = -1;
};

std::string unread_by_filter(H5Z_filter_t filter) {
  OneDataset file;
  file.make_filtered("current_A", filter, false);
  const std::vector<std::string> unread = file.unread();
  return unread.size() == 1 ? unread.front() : "";
}

TEST(Hdf5Unread, NamesTheCompressionThatIsMissingAndHowToBeRidOfIt) {
  for (const auto& [filter, name] : std::vector<std::pair<H5Z_filter_t, std::string>>{
           {32000, "lzf"}, {32001, "blosc"}, {32026, "blosc2"}, {32004, "lz4"}, {32015, "zstd"}, {307, "bzip2"}}) {
    EXPECT_THAT(unread_by_filter(filter),
                AllOf(HasSubstr("'current_A' is compressed by " + name + " (HDF5 filter " + std::to_string(filter)),
                      HasSubstr("h5repack -f GZIP=4"), Not(HasSubstr("damaged"))));
  }
  EXPECT_THAT(unread_by_filter(400), HasSubstr("compressed by HDF5 filter 400"));
}

TEST(Hdf5Unread, ASoundFileWithAMissingFilterIsNotCalledDamagedByWhoNeedsIt) {
  OneDataset file;
  file.make_filtered("current_A", 32000, false);
  const std::string said = refusal([&] {
    (void)read_recording(file.close(),
                         {.channels = {}, .required = {Channel::current}, .optional = {}, .stroke_m = {}});
  });
  EXPECT_THAT(said,
              AllOf(HasSubstr("compressed by lzf"), Not(HasSubstr("damaged")), Not(HasSubstr("record it again"))));
}

TEST(Hdf5Unread, ReadsWhatAFilterLeftAsItWas) {
  OneDataset file;
  file.make_filtered("current_A", 32000, true);
  file.make_filtered("time_s", 32000, true);
  const Recording run =
      read_recording(file.close(), {.channels = {}, .required = {Channel::current}, .optional = {}, .stroke_m = {}});
  EXPECT_THAT(run.column(Channel::current), ElementsAre(0.1, 0.2, 0.3, 0.4));
}

TEST(Hdf5Unread, SaysWhyADatasetHoldsNoNumbers) {
  OneDataset file;
  const hid_t text = H5Tcopy(H5T_C_S1), complex = H5Tcreate(H5T_COMPOUND, 16), row = H5Tcreate(H5T_COMPOUND, 16);
  H5Tset_size(text, 8);
  for (const auto& [type, names] : {std::pair{complex, std::pair{"r", "i"}}, {row, {"current", "position"}}}) {
    H5Tinsert(type, names.first, 0, H5T_NATIVE_DOUBLE);
    H5Tinsert(type, names.second, 8, H5T_NATIVE_DOUBLE);
  }
  const hid_t boolean = H5Tenum_create(H5T_NATIVE_INT8);
  const std::int8_t no = 0;
  H5Tenum_insert(boolean, "FALSE", &no);
  file.make("a", text, {4});
  file.make("b", complex, {4});
  file.make("c", row, {4});
  file.make("d", boolean, {4});
  file.make("e", H5T_NATIVE_DOUBLE, {});
  file.make("f", H5T_NATIVE_DOUBLE, {4, 2, 3});
  file.make("g", H5T_NATIVE_DOUBLE, {0});
  EXPECT_THAT(file.unread(), ElementsAre(HasSubstr("'a' holds text"), HasSubstr("'b' holds complex numbers"),
                                         HasSubstr("'c' is a compound of 'current', 'position'; write each of them"),
                                         HasSubstr("'d' holds booleans"), HasSubstr("'e' is a single value"),
                                         HasSubstr("'f' is an array of 4 x 2 x 3"), HasSubstr("'g' is empty")));
  H5Tclose(text), H5Tclose(complex), H5Tclose(row), H5Tclose(boolean);
}

}  // namespace
}  // namespace spoolflow::recording
