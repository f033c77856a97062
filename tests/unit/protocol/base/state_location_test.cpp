#include "protocol/base/state_location.hpp"

#include <gtest/gtest.h>
#include <map>

namespace dripline {
namespace {

TEST(DefaultStateFolder, IsTheFirstThatIsSet) {
  std::map<std::string, std::string, std::less<>> variables;
  const auto folder = [&](bool is_root) {
    return default_state_folder(
        [&](std::string_view name) -> std::optional<std::string> {
          const auto found = variables.find(name);
          return found == variables.end() ? std::nullopt : std::optional(found->second);
        },
        is_root);
  };
  EXPECT_EQ(folder(false).error().code, Errc::NotFound);
  EXPECT_EQ(folder(true).value(), "/var/lib/dripline");
  variables["HOME"] = "/home/u";
  EXPECT_EQ(folder(false).value(), "/home/u/.local/state/dripline");
  variables["XDG_STATE_HOME"] = "/xdg";
  EXPECT_EQ(folder(false).value(), "/xdg/dripline");
  EXPECT_EQ(folder(true).value(), "/var/lib/dripline");
  variables["DRIPLINE_STATE"] = "/named";
  EXPECT_EQ(folder(false).value(), "/named");
  EXPECT_EQ(folder(true).value(), "/named");
}

TEST(ProcessEnvironment, TakesAnEmptyVariableForAnUnsetOne) {
  ::setenv("DRIPLINE_TEST_VARIABLE", "", 1);
  EXPECT_EQ(process_environment("DRIPLINE_TEST_VARIABLE"), std::nullopt);
  ::setenv("DRIPLINE_TEST_VARIABLE", "x", 1);
  EXPECT_EQ(process_environment("DRIPLINE_TEST_VARIABLE"), "x");
  ::unsetenv("DRIPLINE_TEST_VARIABLE");
}

}  // namespace
}  // namespace dripline
