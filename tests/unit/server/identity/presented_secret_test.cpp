#include "server/identity/presented_secret.hpp"

namespace dripline::identity {
namespace {

const std::string kSecret(64, 'a');
using From = PresentedSecret::From;

struct HeaderCase {
  const char* name;
  std::string authorization, cookies;
  From from = From::Nothing;
  bool has_secret = false;
};
class Presented : public testing::TestWithParam<HeaderCase> {};

TEST_P(Presented, IsReadFromTheHeaders) {
  const auto& row = GetParam();
  const auto read = read_presented(row.authorization, row.cookies, "dripline");
  EXPECT_EQ(read.from, row.from);
  EXPECT_EQ(read.secret, row.has_secret ? kSecret : "");
}

INSTANTIATE_TEST_SUITE_P(
    , Presented,
    testing::Values(
        HeaderCase{"nothing", "", ""},
        HeaderCase{"bearer", "Bearer " + kSecret, "", From::Bearer, true},
        HeaderCase{"cookie", "", "dripline=" + kSecret, From::Cookie, true},
        HeaderCase{"among_others", "", "a=b; dripline=" + kSecret + " ;c=d", From::Cookie, true},
        HeaderCase{"bearer_before_cookie", "Bearer x", "dripline=" + kSecret, From::Bearer},
        HeaderCase{"basic", "Basic " + kSecret, "dripline=" + kSecret, From::Bearer},
        HeaderCase{"two_cookies", "", "dripline=" + kSecret + "; dripline=" + kSecret,
                   From::Cookie},
        HeaderCase{"two_fields", "", "dripline=" + kSecret + ", dripline=x", From::Cookie},
        HeaderCase{"longer_name", "", "xdripline=" + kSecret + "; dripline2=" + kSecret},
        HeaderCase{"no_value", "", "dripline", From::Nothing},
        HeaderCase{"empty", "", "dripline=", From::Cookie},
        HeaderCase{"short", "", "dripline=abc", From::Cookie},
        HeaderCase{"blank_inside", "Bearer " + kSecret + " x", "", From::Bearer},
        HeaderCase{"a_megabyte", "Bearer " + std::string(1 << 20, 'a'), "", From::Bearer}),
    [](const auto& i) { return std::string(i.param.name); });

TEST(SessionCookie, IsForNoScriptAndNoOtherSite) {
  EXPECT_EQ(set_cookie("S", false), "dripline=S; Path=/; HttpOnly; SameSite=Strict");
  EXPECT_EQ(set_cookie("S", true), "__Host-dripline=S; Path=/; HttpOnly; SameSite=Strict; Secure");
  EXPECT_EQ(clear_cookie(false), "dripline=; Path=/; HttpOnly; SameSite=Strict; Max-Age=0");
}

}  // namespace
}  // namespace dripline::identity
