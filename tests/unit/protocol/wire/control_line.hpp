#pragma once

#include <gtest/gtest.h>

#include "tests/support/line/line_events.hpp"

/// Lines of particular controls, by their templates.
namespace dripline::wire {

using Setting = std::pair<std::string_view, std::string_view>;

inline LineSettings template_with(std::string_view name, std::initializer_list<Setting> set = {}) {
  const auto found = find_template(name);
  EXPECT_TRUE(found);
  LineSettings settings = (*found)->settings;
  for (const auto& [key, value] : set) EXPECT_TRUE(set_value(settings, key, value)) << key;
  return settings;
}

/// A control that waits for text.
inline test_support::TestedLine receiving(std::string_view name,
                                          std::initializer_list<Setting> set = {}) {
  test_support::TestedLine control(template_with(name, set), Role::Control);
  const auto begun = control.line->begin_receive("", control.now);
  EXPECT_TRUE(begun) << begun.error().what;
  control.say();
  control.events();
  return control;
}

}  // namespace dripline::wire
