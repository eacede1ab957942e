#include "addons/live/http/secret_hash.hpp"

#include <charconv>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/rand.h>

#include "addons/live/page_settings.hpp"

namespace spoolflow::live {
namespace {

constexpr std::size_t salt_bytes = 16, hash_bytes = 32;
/// Cost of new hashes: 32 MB and about a tenth of a second (OWASP's for 2^15: p = 3; here p = 1 and a limit of trials).
constexpr int cost_log2 = 15, block_size = 8, parallelism = 1;
constexpr int dearest_log2 = 18, largest_block = 16, most_parallel = 8;

std::vector<std::uint8_t> random_bytes(std::size_t count) {
  std::vector<std::uint8_t> out(count);
  if (RAND_bytes(out.data(), static_cast<int>(count)) != 1) {
    throw SiteError("the system gives no random numbers, without which no secret is made");
  }
  return out;
}

/// Base64 without padding.
std::string base64(std::span<const std::uint8_t> bytes) {
  std::string out(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int length =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(out.data()), bytes.data(), static_cast<int>(bytes.size()));
  out.resize(static_cast<std::size_t>(length));
  while (out.ends_with('=')) out.pop_back();
  return out;
}

std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text, std::size_t bytes) {
  std::string padded(text);
  while (padded.size() % 4 != 0) padded += '=';
  std::vector<std::uint8_t> out(padded.size());
  const int length = EVP_DecodeBlock(out.data(), reinterpret_cast<const unsigned char*>(padded.data()),
                                     static_cast<int>(padded.size()));
  if (text.size() != (4 * bytes + 2) / 3 || length < static_cast<int>(bytes)) return std::nullopt;
  out.resize(bytes);
  return out;
}

struct Hash {
  int log2 = 0, block = 0, parallel = 0;
  std::vector<std::uint8_t> salt, hash;
};

/// The part up to the next `end`, which is taken off with it.
std::string_view part(std::string_view& rest, char end) {
  const std::size_t at = rest.find(end);
  const std::string_view out = rest.substr(0, at);
  rest = at == std::string_view::npos ? std::string_view() : rest.substr(at + 1);
  return out;
}

std::optional<int> cost_of(std::string_view text, std::string_view before, int most) {
  if (!text.starts_with(before)) return std::nullopt;
  text.remove_prefix(before.size());
  int out = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (error != std::errc() || end != text.data() + text.size() || out < 1 || out > most) return std::nullopt;
  return out;
}

std::optional<Hash> parsed(std::string_view text) {
  if (!text.starts_with("$scrypt$")) return std::nullopt;
  text.remove_prefix(8);
  std::string_view cost = part(text, '$');
  const auto log2 = cost_of(part(cost, ','), "ln=", dearest_log2),
             block = cost_of(part(cost, ','), "r=", largest_block), parallel = cost_of(cost, "p=", most_parallel);
  const auto salt = from_base64(part(text, '$'), salt_bytes), hash = from_base64(text, hash_bytes);
  if (!log2 || !block || !parallel || !salt || !hash) return std::nullopt;
  return Hash{*log2, *block, *parallel, *salt, *hash};
}

std::optional<std::vector<std::uint8_t>> scrypt(std::string_view secret, const Hash& of) {
  std::vector<std::uint8_t> out(hash_bytes);
  const std::uint64_t cost = std::uint64_t{1} << of.log2;
  const std::uint64_t memory =
      128 * (cost + static_cast<std::uint64_t>(of.parallel) + 2) * static_cast<std::uint64_t>(of.block);
  const int done = EVP_PBE_scrypt(secret.data(), secret.size(), of.salt.data(), of.salt.size(), cost,
                                  static_cast<std::uint64_t>(of.block), static_cast<std::uint64_t>(of.parallel),
                                  2 * memory, out.data(), out.size());
  return done == 1 ? std::optional(out) : std::nullopt;
}

}  // namespace

std::string secret_hash(std::string_view secret) {
  Hash made{cost_log2, block_size, parallelism, random_bytes(salt_bytes), {}};
  const auto hash = scrypt(secret, made);
  if (!hash) throw SiteError("the secret could not be hashed: there is too little memory");
  return fmt::format("$scrypt$ln={},r={},p={}${}${}", made.log2, made.block, made.parallel, base64(made.salt),
                     base64(*hash));
}

bool is_secret_hash(std::string_view hash) {
  return parsed(hash).has_value();
}

bool holds(std::string_view hash, std::string_view secret) {
  const auto kept = parsed(hash);
  if (!kept) return false;
  const auto asked = scrypt(secret, *kept);
  return asked && CRYPTO_memcmp(asked->data(), kept->hash.data(), hash_bytes) == 0;
}

std::string random_token() {
  std::string out = base64(random_bytes(32));
  for (char& c : out) c = c == '+' ? '-' : c == '/' ? '_' : c;
  return out;
}

Digest digest_of(std::string_view text) {
  Digest out{};
  unsigned length = 0;
  EVP_Digest(text.data(), text.size(), out.data(), &length, EVP_sha256(), nullptr);
  return out;
}

}  // namespace spoolflow::live
