/// The yardstick for `estimate`: parses every column of a CSV file with std::from_chars and writes two columns.
/// plain_parse INPUT.csv OUTPUT.csv
#include <array>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <unistd.h>
#include <vector>

namespace {

class Output {
 public:
  explicit Output(const char* name) : file_(::open(name, O_WRONLY | O_CREAT | O_TRUNC, 0666)) {}
  ~Output() {
    flush();
    ::close(file_);
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void row(double a, double b) {
    if (text_.size() - used_ < 64) flush();
    number(a, ',');
    number(b, '\n');
  }

 private:
  void number(double value, char after) {
    char* end = std::to_chars(text_.data() + used_, text_.data() + text_.size(), value).ptr;
    *end++ = after;
    used_ = static_cast<std::size_t>(end - text_.data());
  }
  void flush() {
    if (::write(file_, text_.data(), used_) != static_cast<ssize_t>(used_)) std::perror("plain_parse");
    used_ = 0;
  }
  int file_;
  std::vector<char> text_ = std::vector<char>(std::size_t{256} * 1024);
  std::size_t used_ = 0;
};

/// One line into numbers; returns how many there are.
std::size_t parse(const char* from, const char* end, std::array<double, 64>& numbers) {
  std::size_t count = 0;
  while (from < end && count < numbers.size()) {
    const auto read = std::from_chars(from, end, numbers[count++]);
    from = read.ptr + 1;  // the separator
  }
  return count;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const int input = ::open(argv[1], O_RDONLY);
  Output output(argv[2]);
  std::vector<char> text(std::size_t{1} << 20);
  std::array<double, 64> numbers{};
  std::size_t kept = 0;
  bool header = true;
  for (ssize_t got = 0; (got = ::read(input, text.data() + kept, text.size() - kept)) > 0;) {
    const char* from = text.data();
    const char* const end = from + kept + static_cast<std::size_t>(got);
    while (const void* found = std::memchr(from, '\n', static_cast<std::size_t>(end - from))) {
      const char* line_end = static_cast<const char*>(found);
      if (!header && parse(from, line_end, numbers) > 1) output.row(numbers[0], numbers[1]);
      header = false;
      from = line_end + 1;
    }
    kept = static_cast<std::size_t>(end - from);
    std::memmove(text.data(), from, kept);
  }
  return 0;
}
