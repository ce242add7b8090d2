#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "vspring/error.hpp"

namespace vspring::support {

/// The message, one line, of a call that must be refused with a code.
inline std::string refusal(const std::function<void()>& call, ErrorCode code) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line";
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return "";
}

inline bool says(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

}  // namespace vspring::support
