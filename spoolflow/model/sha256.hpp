#pragma once
#include <memory>
#include <string>
#include <string_view>

namespace spoolflow::model {

/// SHA-256 of what is put in piece by piece. By OpenSSL; a build without it brings its own source of this class.
class Sha256 {
 public:
  /// Throws std::runtime_error where the library has no SHA-256.
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::string_view bytes);
  /// 64 digits. Once, at the end.
  [[nodiscard]] std::string hexadecimal();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace spoolflow::model
