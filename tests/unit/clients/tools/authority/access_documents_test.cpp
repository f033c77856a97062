#include "clients/tools/authority/access_documents.hpp"

#include <gtest/gtest.h>

#include "protocol/dds/impl/topic.hpp"
#include "protocol/dds/qos.hpp"

namespace dripline::authority::test {
namespace {

const Validity kValidity{UtcTime(std::chrono::seconds(1'790'000'000)),
                         UtcTime(std::chrono::seconds(1'800'000'000))};

/// What lies between two texts.
std::string part(const std::string& text, const std::string& from, const std::string& to) {
  const auto begin = text.find(from);
  const auto end = text.find(to, begin);
  return begin == std::string::npos || end == std::string::npos ? std::string()
                                                                : text.substr(begin, end - begin);
}

template <class... Messages>
std::string topics() {
  std::string text;
  ((text += "<topic>" + std::string(dds::Topic<Messages>::kName) + "</topic>"), ...);
  return "<topics>" + text + "</topics>";
}

std::string from_gateway() {
  return topics<dds::Announce, dds::Status, dds::Record, dds::CommandResult, dds::BlockRequest,
                dds::LineData>();
}
std::string from_server() {
  return topics<dds::RecordAck, dds::Command, dds::BlockData, dds::LineRequest>();
}

TEST(Permissions, OfAGatewayAreItsDirectionInItsMachinesPartition) {
  const auto text =
      permissions_document({Role::Gateway, "lathe-1"}, "CN=lathe-1,OU=gateway,O=shop", kValidity);
  const auto publish = part(text, "<publish>", "</publish>");
  const auto subscribe = part(text, "<subscribe>", "</subscribe>");
  EXPECT_NE(publish.find(from_gateway()), std::string::npos) << publish;
  EXPECT_NE(subscribe.find(from_server()), std::string::npos) << subscribe;
  for (const auto& rule : {publish, subscribe}) {
    EXPECT_NE(rule.find("<partition>" + dds::partition_of("lathe-1") + "</partition>"),
              std::string::npos);
    EXPECT_EQ(rule.find('*'), std::string::npos);
  }
  EXPECT_NE(text.find("<subject_name>CN=lathe-1,OU=gateway,O=shop</subject_name>"),
            std::string::npos);
  EXPECT_NE(text.find("<default>DENY</default>"), std::string::npos);
  EXPECT_NE(text.find("<not_before>2026-09-21T14:13:20Z</not_before>"), std::string::npos) << text;
  EXPECT_NE(text.find("<not_after>2027-01-15T08:00:00Z</not_after>"), std::string::npos) << text;
}

TEST(Permissions, OfTheServerAreTheOtherDirectionInAllPartitions) {
  const auto text = permissions_document(the_server(), "CN=server,OU=server,O=shop", kValidity);
  EXPECT_NE(part(text, "<publish>", "</publish>").find(from_server()), std::string::npos);
  EXPECT_NE(part(text, "<subscribe>", "</subscribe>").find(from_gateway()), std::string::npos);
  EXPECT_NE(text.find("<partition>" + dds::partition_of_all() + "</partition>"), std::string::npos);
}

TEST(Governance, EncryptsAndAsksForCertificates) {
  const auto text = governance_document();
  for (const std::string part :
       {"<allow_unauthenticated_participants>false<", "<enable_join_access_control>true<",
        "<discovery_protection_kind>ENCRYPT<", "<data_protection_kind>ENCRYPT<",
        "<enable_read_access_control>true<", "<enable_write_access_control>true<"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace dripline::authority::test
