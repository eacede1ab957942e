#include "spoolflow/export/fmu/resource.hpp"

#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "spoolflow/numerics/checksum.hpp"

namespace spoolflow::exports::fmu {
namespace {

static_assert(std::endian::native == std::endian::little && sizeof(double) == 8);

constexpr std::string_view magic = "spoolflow fmu 1\n";

void put(std::string& out, std::uint64_t value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put(std::string& out, const std::string& text) {
  put(out, text.size());
  out += text;
}

/// Takes values off the front; false once there are too few bytes.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : left_(bytes) {}

  bool take(std::uint64_t& value) {
    if (left_.size() < sizeof value) return false;
    std::memcpy(&value, left_.data(), sizeof value);
    left_.remove_prefix(sizeof value);
    return true;
  }
  bool take(std::string& text) {
    std::uint64_t size = 0;
    if (!take(size) || left_.size() < size) return false;
    text.assign(left_.substr(0, size));
    left_.remove_prefix(size);
    return true;
  }
  bool take(std::vector<double>& numbers) {
    std::uint64_t count = 0;
    if (!take(count) || left_.size() / sizeof(double) < count) return false;
    numbers.resize(count);
    if (count > 0) std::memcpy(numbers.data(), left_.data(), count * sizeof(double));
    left_.remove_prefix(count * sizeof(double));
    return true;
  }
  [[nodiscard]] bool empty() const { return left_.empty(); }

 private:
  std::string_view left_;
};

}  // namespace

std::string resource_bytes(const Resource& resource) {
  std::string out(magic);
  put(out, resource.kind);
  put(out, resource.token);
  put(out, resource.name);
  put(out, resource.numbers.size());
  out.append(reinterpret_cast<const char*>(resource.numbers.data()), resource.numbers.size() * sizeof(double));
  put(out, numerics::checksum(out.data(), out.size()));
  return out;
}

Resource parse_resource(std::string_view bytes, const std::string& file) {
  const std::string remedy = "; export the FMU again with `spoolflow export fmu`";
  if (!bytes.starts_with(magic))
    throw ResourceError(file + ": is no resource of a spoolflow FMU of this version" + remedy);
  std::uint64_t expected = 0;
  if (bytes.size() < magic.size() + sizeof expected) throw ResourceError(file + ": the file was cut short" + remedy);
  const std::string_view body = bytes.substr(0, bytes.size() - sizeof expected);
  std::memcpy(&expected, bytes.data() + body.size(), sizeof expected);
  if (numerics::checksum(body.data(), body.size()) != expected) {
    throw ResourceError(file + ": the file is damaged or was cut short, its checksum does not hold" + remedy);
  }
  Resource out;
  Bytes left(body.substr(magic.size()));
  if (!(left.take(out.kind) && left.take(out.token) && left.take(out.name) && left.take(out.numbers) && left.empty())) {
    throw ResourceError(file + ": the file's parts contradict each other" + remedy);
  }
  return out;
}

Resource read_resource(const std::string& folder, const std::string& token) {
  const std::filesystem::path file =
      std::filesystem::path(std::u8string(folder.begin(), folder.end())) / std::string(resource_name);
  const std::string name = folder + "/" + resource_name;
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw ResourceError(name +
                        ": cannot be opened; the importer must unpack the FMU's resources and name their folder");
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  Resource out = parse_resource(bytes, name);
  if (out.token != token) {
    throw ResourceError(name + ": belongs to the FMU with token " + out.token + ", the importer gave " + token);
  }
  return out;
}

}  // namespace spoolflow::exports::fmu
