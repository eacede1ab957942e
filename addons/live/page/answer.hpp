#pragma once
/// What is told to those who may read.
#include <string_view>

#include "addons/live/engine.hpp"
#include "addons/live/http/page_content.hpp"

namespace spoolflow::live {

/// `target` as the request has it. No path reaches the file system: each is one of a few known ones.
[[nodiscard]] PageAnswer answer_to(const Engine& engine, std::string_view method, std::string_view target);

/// The page of a site, for its door. The engine must have started, and outlive it.
[[nodiscard]] PageContent site_page(Engine& engine);

}  // namespace spoolflow::live
