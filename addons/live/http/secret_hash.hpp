#pragma once
/// Passwords and tokens as they may lie in a file: scrypt (RFC 7914) with a salt, written as a PHC string.
///
///     const std::string kept = secret_hash("correct horse");   // "$scrypt$ln=15,r=8,p=1$SALT$HASH"
///     holds(kept, "correct horse");                            // true, after about a tenth of a second
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace spoolflow::live {

/// Throws SiteError where the system gives no random numbers.
[[nodiscard]] std::string secret_hash(std::string_view secret);
/// Whether the text is such a hash, with a cost that this program can pay.
[[nodiscard]] bool is_secret_hash(std::string_view hash);
/// Takes equally long for every secret. False where the hash is none.
[[nodiscard]] bool holds(std::string_view hash, std::string_view secret);

/// 256 random bits in 43 letters, digits, '-' and '_'.
[[nodiscard]] std::string random_token();

using Digest = std::array<std::uint8_t, 32>;
/// SHA-256.
[[nodiscard]] Digest digest_of(std::string_view text);

}  // namespace spoolflow::live
