#include "server/library/certificate_watch.hpp"

#include <gtest/gtest.h>

#include "tests/support/manual_clock.hpp"

namespace dripline::server_test {
namespace {

using library::CertificateWatch;
using library::WatchedCertificate;
using Level = library::Health::Level;
using Use = WatchedCertificate::Use;
using std::chrono::days;

class CertificateWatchTest : public testing::Test {
 protected:
  WatchedCertificate certificate(Use use, days left, const std::string& machine = {}) const {
    return {.use = use, .machine = machine, .expires = clock_.now() + left};
  }
  std::vector<std::string> findings() const {
    std::vector<std::string> texts;
    for (const auto& finding : health_.state().findings) {
      EXPECT_EQ(finding.subject, "certificate");
      EXPECT_EQ(finding.level, Level::Degraded);
      texts.push_back(finding.what);
    }
    return texts;
  }

  test_support::ManualClock clock_;
  library::Health health_{clock_};
  CertificateWatch watch_{health_, clock_};
};

TEST_F(CertificateWatchTest, WarnsThirtyDaysBeforeEachOneExpires) {
  watch_.look({certificate(Use::Https, days(31)), certificate(Use::Dds, days(30)),
               certificate(Use::Gateway, days(30), "lathe-1")});
  EXPECT_EQ(health_.state().level, Level::Ok);
  watch_.look({certificate(Use::Https, days(29)), certificate(Use::Dds, days(7)),
               certificate(Use::Gateway, days(0), "lathe-1"),
               certificate(Use::Gateway, days(400), "lathe-2")});
  EXPECT_EQ(findings(), (std::vector<std::string>{"the server's DDS certificate expires in 7 days",
                                                  "the DDS certificate of a gateway has expired",
                                                  "the TLS certificate expires in 29 days"}));
}

TEST_F(CertificateWatchTest, NamesTheMachineOnlyToThoseWhoMayKnow) {
  watch_.look({certificate(Use::Gateway, days(3), "lathe-1")});
  const auto state = health_.state();
  ASSERT_EQ(state.findings.size(), 1U);
  EXPECT_EQ(state.findings[0].what.find("lathe-1"), std::string::npos);
  EXPECT_NE(state.findings[0].detail.find("machine=lathe-1"), std::string::npos);
}

TEST_F(CertificateWatchTest, TakesItsWarningBackAfterARenewal) {
  watch_.look({certificate(Use::Gateway, days(3), "lathe-1"),
               certificate(Use::Gateway, days(3), "lathe-2")});
  EXPECT_EQ(findings().size(), 2U);
  watch_.look({certificate(Use::Gateway, days(300), "lathe-1"),
               certificate(Use::Gateway, days(3), "lathe-2")});
  EXPECT_EQ(findings().size(), 1U);
  watch_.look({});
  EXPECT_EQ(health_.state().level, Level::Ok);
}

}  // namespace
}  // namespace dripline::server_test
