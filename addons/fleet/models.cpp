#include "addons/fleet/models.hpp"

#include <zstd.h>

#include "addons/fleet/jobs/contents.hpp"
#include "spoolflow/model/provenance.hpp"

namespace spoolflow::fleet {
namespace {

constexpr unsigned long long largest_model = 64'000'000;
constexpr int model_level = 9;  // it is made seldom, and somebody waits for it

}  // namespace

std::vector<std::uint8_t> pack_model(const std::string& text) {
  return packed(text, model_level);
}

std::optional<std::string> unpack_model(std::span<const std::uint8_t> packed) {
  const unsigned long long length = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (length > largest_model) return std::nullopt;  // also where its length is unknown
  std::string out(length, '\0');
  if (ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size()) != length) return std::nullopt;
  return out;
}

std::optional<live::SharedModel> Models::find(const std::string& sha256) const {
  const std::lock_guard lock(mutex_);
  const auto found = models_.find(sha256);
  if (found == models_.end()) return std::nullopt;
  return found->second;
}

std::optional<live::SharedModel> Models::add(const std::string& sha256, std::span<const std::uint8_t> packed) {
  const std::optional<std::string> text = unpack_model(packed);
  if (!text || model::sha256_of_text(*text) != sha256) return std::nullopt;
  auto read = std::make_shared<const model::Model>(model::parse_model(*text, "the model " + sha256));
  const std::lock_guard lock(mutex_);
  return models_.try_emplace(sha256, live::SharedModel{std::move(read), sha256}).first->second;
}

}  // namespace spoolflow::fleet
