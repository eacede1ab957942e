/// HDF5 files read from many threads: where the processes come from that read them.
#include "spoolflow/recording/files/fork_server.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/recording/files/reading_process.hpp"
#include "spoolflow/recording/open_table.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Ends the whole program where what it stands beside does not come to an end.
class EndsWithin {
 public:
  explicit EndsWithin(unsigned s) { ::alarm(s); }
  ~EndsWithin() { ::alarm(0); }
  EndsWithin(const EndsWithin&) = delete;
  EndsWithin& operator=(const EndsWithin&) = delete;
};

ReadingOrder order(ReadingOrder::Work work) {
  return {work, {.memory_bytes = std::uint64_t{64} << 20, .computing_s = 5}};
}

void wait_for_the_parent(const ReadingOrder&, Connection& parent) {
  std::uint32_t kind = 0;
  std::string content;
  (void)parent.send(0, "ready");
  (void)parent.receive(kind, content);
}

/// How a child ends that does `work`.
std::string end_from_fork_server(ReadingOrder::Work work) {
  ReadingProcess process(order(work));
  std::uint32_t kind = 0;
  std::string content;
  while (process.connection().receive(kind, content)) {
  }
  return process.end();
}

std::string failure_of(const std::function<void()>& start) {
  try {
    start();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing failed";
}

/// Sum of a column of an example: 2001 numbers and more, deflated.
double sum_of_a_column() {
  const auto table = open_sample_table(SPOOLFLOW_EXAMPLES "/valve_a/spring.h5").table;
  table->select({0});
  std::vector<double> numbers(4096);
  double* const out[1]{numbers.data()};
  double sum = 0;
  while (const std::size_t rows = table->read(out, numbers.size())) {
    for (std::size_t k = 0; k < rows; ++k) sum += numbers[k];
  }
  return sum;
}

TEST(ForkServer, ManyThreadsReadWhileOthersAllocate) {
  constexpr int readers = 4, times = 75;
  const EndsWithin limit(240);
  const double expected = sum_of_a_column();
  ASSERT_NE(expected, 0.0);
  std::atomic<int> read{0};
  {
    const ForkServer fork_server;
    const auto allocate = [](const std::stop_token& stop) {
      std::vector<std::string> texts(64);
      for (std::size_t k = 0; !stop.stop_requested(); ++k)
        texts[k % texts.size()] = std::string(1 + 37 * k % 5000, 'x');
    };
    const std::array<std::jthread, 2> allocating{std::jthread(allocate), std::jthread(allocate)};
    std::vector<std::jthread> reading;
    for (int reader = 0; reader < readers; ++reader) {
      reading.emplace_back([&] {
        for (int k = 0; k < times; ++k) read += sum_of_a_column() == expected ? 1 : 0;
      });
    }
  }
  EXPECT_EQ(read, readers * times);
}

TEST(ForkServer, ItsChildrenAreOursAndSayHowTheyEnded) {
  const ForkServer fork_server;
  EXPECT_THAT(end_from_fork_server([](const ReadingOrder&, Connection&) { (void)std::raise(SIGSEGV); }),
              HasSubstr("crashed on it"));
  EXPECT_THAT(end_from_fork_server([](const ReadingOrder&, Connection&) { std::abort(); }), HasSubstr("crashed on it"));
  EXPECT_THAT(end_from_fork_server([](const ReadingOrder&, Connection&) { ::_exit(3); }), HasSubstr("ended before"));
  EXPECT_EQ(::getpgid(fork_server.id()), ::getpgrp());  // it lives on
}

TEST(ForkServer, ForkBesideThreadsIsRefused) {
  const EndsWithin limit(60);
  {
    const std::jthread other([](const std::stop_token& stop) {
      while (!stop.stop_requested()) std::this_thread::yield();
    });
    EXPECT_FALSE(may_fork());
    EXPECT_THAT(failure_of([] { const ReadingProcess process(order(wait_for_the_parent)); }),
                AllOf(HasSubstr("no process can be started"), HasSubstr("several threads")));
    EXPECT_THROW(const ForkServer fork_server, std::logic_error);
  }
  EXPECT_EQ(failure_of([] { const ReadingProcess process(order(wait_for_the_parent)); }), "nothing failed");
}

TEST(ForkServer, OneThatWasEndedIsOneError) {
  const EndsWithin limit(60);
  const ForkServer fork_server;
  ::kill(fork_server.id(), SIGKILL);
  EXPECT_THAT(failure_of([] { const ReadingProcess process(order(wait_for_the_parent)); }),
              HasSubstr("no process can be started to read the recording"));
  EXPECT_THAT(failure_of([] { (void)open_sample_table(SPOOLFLOW_EXAMPLES "/valve_a/spring.h5"); }),
              AllOf(HasSubstr("valve_a/spring.h5: "), HasSubstr("no process can be started")));
}

TEST(ForkServer, HasNothingOpenThatIsOurs) {
  const TemporaryFile file("output.csv", "time_s\n");
  const std::ifstream open_here(file.path());
  const ForkServer fork_server;
  (void)sum_of_a_column();  // it has begun to work
  std::vector<std::string> open_there;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(fork_server.id()) + "/fd")) {
    open_there.push_back(std::filesystem::read_symlink(entry).string());
  }
  EXPECT_EQ(open_there.size(), 4U) << ::testing::PrintToString(open_there);  // 0 to 2, and its socket
  EXPECT_EQ(std::count(open_there.begin(), open_there.end(), file.path().string()), 0);
}

TEST(ForkServer, EndsWithAParentThatIsKilled) {
  const EndsWithin limit(60);
  ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1), 0);  // orphans become children of this process
  std::array<int, 2> pipe{};
  ASSERT_EQ(::pipe(pipe.data()), 0);
  const ::pid_t parent = ::fork();
  if (parent == 0) {
    const ForkServer fork_server;
    ReadingProcess reader(order(wait_for_the_parent));
    std::uint32_t kind = 0;
    std::string content;
    (void)reader.connection().receive(kind, content);
    const std::array<::pid_t, 2> orphans{fork_server.id(), reader.id()};
    (void)!::write(pipe[1], orphans.data(), sizeof orphans);
    for (;;) ::pause();
  }
  std::array<::pid_t, 2> orphans{};
  ASSERT_EQ(::read(pipe[0], orphans.data(), sizeof orphans), static_cast<::ssize_t>(sizeof orphans));
  ::kill(parent, SIGKILL);
  EXPECT_EQ(::waitpid(parent, nullptr, 0), parent);
  for (const ::pid_t orphan : orphans) {
    int status = -1;
    EXPECT_EQ(::waitpid(orphan, &status, 0), orphan);
    EXPECT_TRUE(WIFEXITED(status));
  }
  for (const int end : pipe) ::close(end);
  ::prctl(PR_SET_CHILD_SUBREAPER, 0);
}

TEST(ForkServer, IsStartedOnlyWhereAFileNeedsIt) {
  const TemporaryFile csv("run.csv", "time_s,current_A\n0,1\n");
  const TemporaryFile pipe("run.pipe");
  ASSERT_EQ(::mkfifo(pipe.path().c_str(), 0600), 0);
  EXPECT_EQ(fork_server_for({csv.path(), pipe.path(), "-", "missing.h5", csv.folder()}), nullptr);
  EXPECT_EQ(ForkServer::present(), nullptr);
  const auto fork_server = fork_server_for({csv.path(), SPOOLFLOW_EXAMPLES "/valve_a/spring.h5"});
  EXPECT_NE(fork_server, nullptr);
  EXPECT_EQ(ForkServer::present(), fork_server.get());
}

}  // namespace
}  // namespace spoolflow::recording
