/// Makes the small compressed recordings of this folder: thins, cuts and rounds a CSV recording into integers of a
/// deflated HDF5 file (CF conventions 8.1: value = scale_factor * stored).
/// pack_recording IN.csv OUT.h5 [EVERY=1] [SECONDS=all]
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <hdf5.h>

namespace {

struct Column {
  std::string name;
  std::vector<double> values;
};

/// What a column is rounded to: a fifth of the instrument's noise or finer.
int decimals_of(const std::string& name) {
  if (name.starts_with("time")) return 5;
  if (name.starts_with("position") || name.starts_with("current")) return 4;
  return 2;
}

std::vector<Column> read(const std::string& file, double seconds) {
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line)) throw std::runtime_error(file + ": cannot be read");
  std::vector<Column> columns;
  std::istringstream names(line);
  for (std::string name; std::getline(names, name, ',');) columns.push_back({name, {}});
  while (std::getline(in, line)) {
    const char* at = line.data();
    const char* const end = at + line.size();
    for (Column& column : columns) {
      double value = 0;
      const auto [next, error] = std::from_chars(at, end, value);
      if (error != std::errc()) throw std::runtime_error(file + ": no number in \"" + line + "\"");
      if (&column == &columns.front() && value > seconds) return columns;
      column.values.push_back(value);
      at = next == end ? end : next + 1;
    }
  }
  return columns;
}

/// Every `nth` sample: unlike means, these keep the instruments' noise, from which calibration makes its bands.
void thin(Column& column, std::size_t nth) {
  std::vector<double> kept;
  for (std::size_t k = 0; k < column.values.size(); k += nth) kept.push_back(column.values[k]);
  column.values = std::move(kept);
}

void write(hid_t file, const Column& column) {
  const double scale_factor = std::pow(10.0, -decimals_of(column.name));
  std::vector<std::int32_t> stored;
  for (const double value : column.values)
    stored.push_back(static_cast<std::int32_t>(std::lround(value / scale_factor)));
  const hsize_t size = stored.size();
  const hid_t space = H5Screate_simple(1, &size, nullptr);
  const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(how, 1, &size);
  H5Pset_shuffle(how);
  H5Pset_deflate(how, 9);
  H5Pset_obj_track_times(how, false);
  const hid_t set = H5Dcreate2(file, column.name.c_str(), H5T_STD_I32LE, space, H5P_DEFAULT, how, H5P_DEFAULT);
  const hid_t one = H5Screate(H5S_SCALAR);
  const hid_t attribute = H5Acreate2(set, "scale_factor", H5T_IEEE_F64LE, one, H5P_DEFAULT, H5P_DEFAULT);
  const bool written = H5Awrite(attribute, H5T_NATIVE_DOUBLE, &scale_factor) >= 0 &&
                       H5Dwrite(set, H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, stored.data()) >= 0;
  H5Aclose(attribute);
  H5Sclose(one);
  H5Dclose(set);
  H5Pclose(how);
  H5Sclose(space);
  if (!written) throw std::runtime_error(column.name + ": cannot be written");
}

void pack(const std::string& from, const std::string& to, std::size_t nth, double seconds) {
  std::vector<Column> columns = read(from, seconds);
  const hid_t file = H5Fcreate(to.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  if (file < 0) throw std::runtime_error(to + ": cannot be made");
  for (Column& column : columns) {
    if (nth > 1) thin(column, nth);
    write(file, column);
  }
  H5Fclose(file);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: pack_recording IN.csv OUT.h5 [EVERY=1] [SECONDS=all]\n", stderr);
    return 2;
  }
  try {
    pack(argv[1], argv[2], argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 1,
         argc > 4 ? std::strtod(argv[4], nullptr) : INFINITY);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pack_recording: %s\n", error.what());
    return 1;
  }
}
