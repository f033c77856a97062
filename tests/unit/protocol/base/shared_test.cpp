#include "protocol/base/shared.hpp"

#include <string>

#include <gtest/gtest.h>

namespace dripline {
namespace {

TEST(Shared, HasAValueOrNone) {
  Shared<std::string> text;
  EXPECT_FALSE(text);
  EXPECT_FALSE(text.has_value());
  text = std::string("one");
  ASSERT_TRUE(text);
  EXPECT_EQ(*text, "one");
  EXPECT_EQ(text->size(), 3U);
  text.reset();
  EXPECT_FALSE(text);
  EXPECT_EQ(text.emplace(), "");
  EXPECT_TRUE(text.has_value());
}

TEST(Shared, CopiesShareTheValueUntilOneOfThemIsEdited) {
  Shared<std::string> first(std::string("one"));
  Shared<std::string> second = first;
  EXPECT_EQ(&*first, &*second);
  second.edit() = "two";
  EXPECT_EQ(*first, "one");
  EXPECT_EQ(*second, "two");

  const std::string* const place = &*second;
  second.edit() += "!";
  EXPECT_EQ(&*second, place) << "no one else has it";

  Shared<std::string> third = first;
  third.emplace() = "three";
  EXPECT_EQ(*first, "one");
}

}  // namespace
}  // namespace dripline
