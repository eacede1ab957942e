#pragma once
/// The message with which something is refused, for tests of messages.
#include <string>

#include <gtest/gtest.h>

#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {

template <typename Action>
std::string refusal(Action&& action) {
  try {
    action();
  } catch (const RecordingError& error) {
    return error.what();
  }
  ADD_FAILURE() << "was not refused";
  return {};
}

}  // namespace spoolflow::recording
