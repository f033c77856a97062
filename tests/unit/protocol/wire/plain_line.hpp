#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include <gtest/gtest.h>

#include "tests/support/line/line_events.hpp"

namespace dripline::wire {

inline const std::string kDc1 = "\x11", kDc3 = "\x13";

inline LineSettings settings_with(
    std::initializer_list<std::pair<std::string_view, std::string_view>> set) {
  LineSettings settings;
  for (const auto& [key, value] : set) {
    const auto done = set_value(settings, key, value);
    EXPECT_TRUE(done) << key << ": " << (done ? "" : done.error().what);
  }
  return settings;
}

}  // namespace dripline::wire
