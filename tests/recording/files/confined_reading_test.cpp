/// HDF5 and MATLAB files are read in a process in a sandbox: what such a file can do to it, and what of that is seen.
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <functional>
#include <string>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <matio.h>

#include "spoolflow/recording/files/confined_table.hpp"
#include "spoolflow/recording/files/hdf5_handle.hpp"
#include "spoolflow/recording/files/reading_process.hpp"
#include "spoolflow/recording/open_table.hpp"
#include "tests/recording/refusal.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr ReadingLimits small_limits{.memory_bytes = std::uint64_t{64} << 20, .computing_s = 1};

/// An order for what a test captures, whose address means the same only in a child that is forked now.
ReadingOrder order_of(const std::function<void(Connection&)>& work) {
  const auto* const address = &work;
  return {[](const ReadingOrder& order, Connection& parent) {
            const std::function<void(Connection&)>* ordered = nullptr;
            std::memcpy(&ordered, order.bytes.data(), sizeof ordered);
            (*ordered)(parent);
          },
          small_limits, std::string(reinterpret_cast<const char*>(&address), sizeof address)};
}

/// How a child ends that does `work`, after it has given up its rights.
std::string end_of(const std::function<void(Connection&)>& work) {
  ReadingProcess process(order_of(work));
  std::uint32_t kind = 0;
  std::string content;
  while (process.connection().receive(kind, content)) {
  }
  return process.end();
}

TEST(ReadingProcess, SaysHowItCrashed) {
  EXPECT_THAT(end_of([](Connection&) { (void)std::raise(SIGSEGV); }), HasSubstr("crashed on it"));
  EXPECT_THAT(end_of([](Connection&) { ::_exit(3); }), HasSubstr("ended before"));
}

TEST(ReadingProcess, IsStoppedWhereItComputesWithoutEnd) {
  volatile bool forever = true;
  EXPECT_THAT(end_of([&](Connection&) {
                while (forever) {
                }
              }),
              HasSubstr("more than 1 s of computing"));
}

#if !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)  // the build with sanitizers, whose own calls no list knows
/// What a child answers in one word.
std::string answer_of(const std::function<std::string()>& work) {
  const std::function<void(Connection&)> answer = [&](Connection& parent) {
    give_up_opening();
    (void)parent.send(0, work());
  };
  ReadingProcess process(order_of(answer));
  std::uint32_t kind = 0;
  std::string content;
  return process.connection().receive(kind, content) ? content : "nothing";
}

TEST(ReadingProcess, OpensNothingAndReachesNobody) {
  EXPECT_EQ(answer_of([] { return ::open("/etc/passwd", O_RDONLY) < 0 ? "refused" : "opened"; }), "refused");
  EXPECT_EQ(answer_of([] { return ::fork() < 0 ? "refused" : "started"; }), "refused");
  EXPECT_EQ(answer_of([] { return ::kill(::getppid(), 0) < 0 ? "refused" : "reached"; }), "refused");
}
#endif

TEST(ReadingProcess, GoesWithTheOneThatStartedIt) {
  const std::function<void(Connection&)> wait = [](Connection& parent) {
    std::uint32_t kind = 0;
    std::string content;
    (void)parent.receive(kind, content);
  };
  ::pid_t child = 0;
  {
    const ReadingProcess process(order_of(wait));
    child = process.id();
    EXPECT_EQ(::kill(child, 0), 0);
  }
  EXPECT_NE(::kill(child, 0), 0);
}

/// An HDF5 file that holds what `fill` puts into it.
void make_hdf5(const std::filesystem::path& path, const std::function<void(hid_t)>& fill) {
  silence_hdf5();
  const Hdf5Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
  fill(file.id());
}

/// A vector of doubles without values, made with the property list.
void add_vector(hid_t file, const char* name, hsize_t count, hid_t made) {
  const Hdf5Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Hdf5Handle dataset(H5Dcreate2(file, name, H5T_NATIVE_DOUBLE, space.id(), H5P_DEFAULT, made, H5P_DEFAULT),
                           H5Dclose);
  ASSERT_TRUE(dataset.valid());
}

std::string refusal_of(const std::filesystem::path& file) {
  return refusal([&] { (void)open_sample_table(file); });
}

TEST(ConfinedReading, ExternalStorageIsRefused) {
  const TemporaryFile file("external.h5");
  make_hdf5(file.path(), [](hid_t id) {
    const Hdf5Handle made(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_external(made.id(), "/etc/passwd", 0, 80);
    add_vector(id, "current_A", 10, made.id());
  });
  EXPECT_THAT(refusal_of(file.path()), AllOf(HasSubstr("external.h5"), HasSubstr("'current_A' has external storage")));
}

TEST(ConfinedReading, VirtualDatasetsAreRefused) {
  const TemporaryFile file("virtual.h5");
  make_hdf5(file.path(), [](hid_t id) {
    const hsize_t count = 10;
    const Hdf5Handle made(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    const Hdf5Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
    H5Pset_virtual(made.id(), space.id(), "/tmp/other.h5", "secret", space.id());
    add_vector(id, "current_A", count, made.id());
  });
  EXPECT_THAT(refusal_of(file.path()), HasSubstr("'current_A' is a virtual dataset"));
}

TEST(ConfinedReading, LinksIntoOtherFilesAreRefused) {
  const TemporaryFile file("linked.h5");
  make_hdf5(file.path(), [](hid_t id) {
    add_vector(id, "time_s", 10, H5P_DEFAULT);
    H5Lcreate_external("/tmp/other.h5", "secret", id, "current_A", H5P_DEFAULT, H5P_DEFAULT);
  });
  EXPECT_THAT(refusal_of(file.path()), HasSubstr("'current_A' is an external link"));
}

TEST(ConfinedReading, ASparseFileThatClaimsGigabytesIsRefused) {
  const TemporaryFile file("sparse.h5");
  make_hdf5(file.path(), [](hid_t id) {
    const hsize_t chunk = 1024;
    const Hdf5Handle made(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(made.id(), 1, &chunk);
    add_vector(id, "current_A", hsize_t{1} << 30, made.id());
  });
  ASSERT_LT(std::filesystem::file_size(file.path()), 4096U);
  EXPECT_THAT(refusal_of(file.path()), AllOf(HasSubstr("'current_A'"), HasSubstr("8192 MiB of numbers")));
}

TEST(ConfinedReading, AMatlabFileThatInflatesOutOfProportionIsRefused) {
  const TemporaryFile file("zeros.mat");
  {
    std::vector<double> zeros(std::size_t{8} << 20);
    std::size_t size[2]{zeros.size(), 1};
    mat_t* const mat = Mat_CreateVer(file.path().c_str(), nullptr, MAT_FT_MAT5);
    matvar_t* const variable = Mat_VarCreate("current_A", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, zeros.data(), 0);
    Mat_VarWrite(mat, variable, MAT_COMPRESSION_ZLIB);
    Mat_VarFree(variable);
    Mat_Close(mat);
  }
  EXPECT_THAT(refusal_of(file.path()), AllOf(HasSubstr("zeros.mat"), HasSubstr("64 MiB of numbers")));
}

constexpr std::uint64_t samples = 400000;

std::function<void()> deed;  ///< of the library below

/// Stands for a library that misbehaves when it is asked for numbers.
class Misbehaving final : public VectorTable {
 public:
  Misbehaving() : VectorTable("run.h5") { add({{"current_A", "current_A", {}}, samples}); }
  void copy(std::size_t, std::uint64_t first, std::size_t count, double* out) override {
    if (first > 0) deed();
    for (std::size_t k = 0; k < count; ++k) out[k] = static_cast<double>(first + k);
  }
};

/// Reads the column of such a table, 1000 numbers at a time; how it was refused, and how many numbers came before.
struct Course {
  std::string message;
  std::uint64_t read = 0;
};
Course course_of(std::function<void()> wanted) {
  deed = std::move(wanted);
  const auto table = open_confined("run.h5", 1000, [](const std::filesystem::path&) -> std::unique_ptr<VectorTable> {
    return std::make_unique<Misbehaving>();
  });
  table->select({0});
  std::vector<double> numbers(1000);
  double* const out[1]{numbers.data()};
  Course course;
  course.message = refusal([&] {
    while (const std::size_t rows = table->read(out, numbers.size())) {
      for (std::size_t k = 0; k < rows; ++k) EXPECT_EQ(numbers[k], static_cast<double>(course.read + k));
      course.read += rows;
    }
    if (course.read == samples) throw RecordingError("read to its end");
  });
  return course;
}

TEST(ConfinedReading, NumbersAndWordsOfTheChildArriveWhole) {
  const Course well = course_of([] {});
  EXPECT_EQ(well.message, "read to its end");
  EXPECT_EQ(well.read, samples);
  const Course refused = course_of([] { throw RecordingError("run.h5: dataset 'current_A' is damaged"); });
  EXPECT_EQ(refused.message, "run.h5: dataset 'current_A' is damaged");
  EXPECT_GT(refused.read, 1000U);  // what was read before it comes first
}

TEST(ConfinedReading, ACrashOfTheLibraryIsOneError) {
  EXPECT_THAT(course_of([] { __builtin_trap(); }).message,
              AllOf(HasSubstr("run.h5: is damaged or hostile"), HasSubstr("crashed on it")));
}

#if !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)  // the build with sanitizers, which reserves terabytes
TEST(ConfinedReading, MemoryOutOfProportionIsOneError) {
  EXPECT_THAT(course_of([] { std::vector<double>(std::size_t{1} << 27).front() = 1; }).message,
              AllOf(HasSubstr("run.h5"), HasSubstr("more than 512 MiB of memory")));
}
#endif

}  // namespace
}  // namespace spoolflow::recording
