#include "server/api/events/tracked_text.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

namespace dripline::api {
namespace {

using Json = nlohmann::ordered_json;

/// As a client does it (openapi.json, MachineChange).
void join(Json& into, const Json& change) {
  for (const auto& [name, value] : change.items()) {
    if (value.is_object() && into.contains(name) && into[name].is_object()) {
      join(into[name], value);
    } else {
      into[name] = value;
    }
  }
}

/// The change after `version`, without what every change has.
Json changed(TrackedText& text, std::uint64_t version) {
  Json change = Json::parse(text.change_after(version));
  EXPECT_EQ(change["after"], version);
  EXPECT_EQ(change["version"], text.version());
  for (const char* member : {"after", "version", "name"}) change.erase(member);
  return change;
}

TEST(TrackedText, IsWholeWithItsVersion) {
  TrackedText text;
  EXPECT_EQ(text.version(), 0U);
  text.update(R"({"name":"m1","status":null})");
  EXPECT_EQ(text.whole(), R"({"version":1,"name":"m1","status":null})");
  text.update("{}");
  EXPECT_EQ(text.whole(), R"({"version":2})");
}

TEST(TrackedText, WritesOnlyTheMembersThatHaveChanged) {
  TrackedText text;
  text.update(R"({"name":"m1","held":null,"status":{"line":1,"at":{"X":1,"Z":2},"mode":"A"}})");
  text.update(R"({"name":"m1","held":null,"status":{"line":2,"at":{"X":1,"Z":3},"mode":"A"}})");
  EXPECT_EQ(text.change_after(1),
            R"({"after":1,"version":2,"name":"m1","status":{"line":2,"at":{"Z":3}}})");
}

TEST(TrackedText, WritesWhatChangedSinceAnyEarlierVersion) {
  TrackedText text;
  text.update(R"({"name":"m1","a":1,"b":1,"c":1})");
  text.update(R"({"name":"m1","a":2,"b":1,"c":1})");
  text.update(R"({"name":"m1","a":2,"b":2,"c":1})");
  EXPECT_EQ(changed(text, 1), (Json{{"a", 2}, {"b", 2}}));
  EXPECT_EQ(changed(text, 2), (Json{{"b", 2}}));
  EXPECT_EQ(changed(text, 1), (Json{{"a", 2}, {"b", 2}})) << "again";
  text.update(R"({"name":"m1","a":1,"b":2,"c":1})");
  EXPECT_EQ(changed(text, 1), (Json{{"a", 1}, {"b", 2}})) << "back again is a change too";
}

TEST(TrackedText, HasNoNewVersionWithoutAChange) {
  TrackedText text;
  text.update(R"({"name":"m1","a":1})");
  text.update(R"({"name":"m1","a":1})");
  EXPECT_EQ(text.version(), 1U);
}

struct OtherMembers {
  const char* name;
  const char* before;
  const char* now;
};
class TrackedTextOf : public testing::TestWithParam<OtherMembers> {};

TEST_P(TrackedTextOf, IsSentWhole) {
  TrackedText text;
  text.update(GetParam().before);
  text.update(GetParam().now);
  EXPECT_EQ(text.same_members_since(), 2U);
}

INSTANTIATE_TEST_SUITE_P(
    OtherMembers, TrackedTextOf,
    testing::Values(
        OtherMembers{"one_more", R"({"a":1})", R"({"a":1,"b":1})"},
        OtherMembers{"one_less", R"({"a":1,"b":1})", R"({"a":1})"},
        OtherMembers{"none_left", R"({"a":1})", R"({})"},
        OtherMembers{"another_name", R"({"a":1})", R"({"b":1})"},
        OtherMembers{"one_less_inside", R"({"a":{"X":1,"Y":1}})", R"({"a":{"X":1}})"},
        OtherMembers{"moved_inside", R"({"a":{"X":1},"b":1})", R"({"a":{"X":1,"b":1}})"},
        OtherMembers{"an_object_goes", R"({"a":{"X":1}})", R"({"a":null})"},
        OtherMembers{"an_object_comes", R"({"a":null})", R"({"a":{"X":1}})"},
        OtherMembers{"an_empty_object_comes", R"({"a":null})", R"({"a":{}})"},
        OtherMembers{"one_more_after_a_change", R"({"a":1,"b":{"X":1}})",
                     R"({"a":2,"b":{"X":1,"Y":1}})"},
        OtherMembers{"one_more_between", R"({"a":1,"b":1})", R"({"a":2,"a2":1,"b":1})"},
        OtherMembers{"an_object_for_a_number", R"({"a":1,"b":1})", R"({"a":{"X":1},"b":1})"},
        OtherMembers{"more_text_after_it", R"({"a":1})", R"({"a":1}})"},
        OtherMembers{"no_json", R"({"a":1})", R"({"a":1)"},
        OtherMembers{"no_object", R"([1])", R"([2])"},
        OtherMembers{"an_open_text", R"({"a":"1"})", R"({"a":"1\"})"},
        OtherMembers{"an_open_list", R"({"a":[1]})", R"({"a":[[1]})"}),
    [](const auto& i) { return std::string(i.param.name); });

TEST(TrackedText, SendsWholeWhatIsNestedTooDeep) {
  const auto nested = [](std::size_t depth, const char* value) {
    std::string text;
    for (std::size_t i = 0; i < depth; ++i) text += R"({"a":)";
    return text + value + std::string(depth, '}');
  };
  for (const std::size_t depth : {TrackedText::kMaxDepth, TrackedText::kMaxDepth + 1}) {
    TrackedText text;
    text.update(nested(depth, "1"));
    text.update(nested(depth, "2"));
    EXPECT_EQ(text.same_members_since(), depth > TrackedText::kMaxDepth ? 2U : 1U) << depth;
  }
}

TEST(TrackedText, ReadsTextsWithWhatLooksLikeStructure) {
  TrackedText text;
  text.update(R"({"name":"m1","a":"},{\"b\":[\\","b":[{"c":"]}"},[1]],"d":1})");
  text.update(R"({"name":"m1","a":"},{\"b\":[\\","b":[{"c":"]"},[1]],"d":1})");
  EXPECT_EQ(text.change_after(1), R"({"after":1,"version":2,"name":"m1","b":[{"c":"]"},[1]]})");
}

class RandomMachine {
 public:
  explicit RandomMachine(unsigned seed) : random_(seed) {}

  /// Now and then with other members, mostly with other values.
  std::string next() {
    if (one_of(12))
      state_["held"] = one_of(2) ? Json(nullptr) : Json{{"who", "anna"}, {"n", any()}};
    if (one_of(12)) state_["status"] = one_of(3) ? Json(nullptr) : status();
    if (state_["status"].is_object()) {
      for (auto& [name, value] : state_["status"].items()) {
        if (one_of(3) && !value.is_object()) value = any();
        if (one_of(3) && value.is_object()) value["X"] = any();
      }
    }
    if (one_of(2)) state_["notices"] = Json::array({any(), Json{{"deep", any()}}});
    return state_.dump();
  }

 private:
  bool one_of(unsigned n) { return random_() % n == 0; }
  Json any() {
    switch (random_() % 5) {
      case 0:
        return nullptr;
      case 1:
        return "te,x}t \"\\" + std::to_string(random_() % 9);
      case 2:
        return 0.5 * static_cast<double>(random_() % 9);
      default:
        return random_() % 9;
    }
  }
  Json status() {
    Json status{{"line", any()}, {"message", any()}, {"at", {{"X", any()}}}};
    if (one_of(2)) status["at"]["Z"] = any();
    if (one_of(2)) status["modes"] = {{"X", any()}, {"tool", {{"X", any()}}}};
    return status;
  }

  std::mt19937 random_;
  Json state_{{"name", "m1"}, {"held", nullptr}, {"status", nullptr}, {"notices", nullptr}};
};

TEST(TrackedText, JoinedChangesAreTheWholeState) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    RandomMachine machine(seed);
    TrackedText text;
    std::mt19937 random(seed);
    Json known;
    std::uint64_t version = 0;
    std::size_t changes = 0;
    for (int i = 0; i < 200; ++i) {
      text.update(machine.next());
      if (random() % 3 == 0) continue;  // a listener that is slower
      if (version == 0 || version < text.same_members_since()) {
        known = Json::parse(text.whole());
      } else if (version != text.version()) {
        ++changes;
        Json change = Json::parse(text.change_after(version));
        change.erase("after");
        join(known, change);
      }
      version = text.version();
      ASSERT_EQ(known.dump(), Json::parse(text.whole()).dump()) << "seed " << seed << ", " << i;
    }
    EXPECT_GT(changes, 20U) << "seed " << seed;
  }
}

}  // namespace
}  // namespace dripline::api
