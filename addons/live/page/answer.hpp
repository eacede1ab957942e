#pragma once
/// What is reported to those who may read.
#include <stop_token>
#include <string_view>

#include "addons/live/engine.hpp"
#include "addons/live/http/page_content.hpp"

namespace spoolflow::live {

/// `target` as the request has it. No path reaches the file system: each is one of a few known ones.
/// Days of a valve are read until it is asked to stop, or for so long that a span is too large for this machine.
[[nodiscard]] PageAnswer answer_to(const Engine& engine, std::string_view method, std::string_view target,
                                   const std::stop_token& stop = {});

/// The page of a site, for its access. The engine must have started, and outlive it.
[[nodiscard]] PageContent site_page(Engine& engine);

}  // namespace spoolflow::live
