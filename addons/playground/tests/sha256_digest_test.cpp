#include "addons/playground/requests/sha256_digest.hpp"

#include <string>

#include <gtest/gtest.h>

#include "spoolflow/model/provenance.hpp"

namespace spoolflow::playground {
namespace {

std::string hexadecimal(const std::string& text) {
  constexpr const char* digits = "0123456789abcdef";
  Sha256Digest digest;
  digest.add(text);
  std::string out;
  for (const std::uint8_t byte : digest.finish()) {
    out += digits[byte / 16];
    out += digits[byte % 16];
  }
  return out;
}

TEST(Sha256Digest, IsThatOfOpenSslForEveryLengthAroundABlock) {
  for (std::size_t length = 0; length < 200; ++length) {
    std::string text;
    for (std::size_t k = 0; k < length; ++k) text += static_cast<char>(k * 37 + length);
    EXPECT_EQ(hexadecimal(text), model::sha256_of_text(text)) << length;
  }
}

TEST(Sha256Digest, DoesNotDependOnThePiecesThatItIsGiven) {
  Sha256Digest whole, pieces;
  whole.add("the valve's recording");
  pieces.add("the valve's");
  pieces.add("");
  pieces.add(" recording");
  EXPECT_EQ(whole.finish(), pieces.finish());
}

}  // namespace
}  // namespace spoolflow::playground
