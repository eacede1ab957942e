// In place of spoolflow/model/sha256.cpp: a browser has no OpenSSL.
#include "spoolflow/model/sha256.hpp"

#include <fmt/format.h>

#include "addons/playground/requests/sha256_digest.hpp"

namespace spoolflow::model {

struct Sha256::State {
  playground::Sha256Digest digest;
};

Sha256::Sha256() : state_(std::make_unique<State>()) {}
Sha256::~Sha256() = default;

void Sha256::add(std::string_view bytes) {
  state_->digest.add(bytes);
}

std::string Sha256::hexadecimal() {
  std::string out;
  for (const std::uint8_t byte : state_->digest.finish()) out += fmt::format("{:02x}", byte);
  return out;
}

}  // namespace spoolflow::model
