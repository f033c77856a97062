// The members that the client library reads against those that server/api/openapi.json describes,
// which the tests of the server compare with its real answers.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "clients/lib/impl/api_members.hpp"

namespace dripline::client {
namespace {

using Json = nlohmann::json;
using Names = std::set<std::string>;

class NameCollector {
 public:
  void operator()(const char* name, const auto&) { names_.insert(name); }
  void flag(const char* name, bool) { names_.insert(name); }
  void later(const char* name, const auto&) { names_.insert(name); }
  Names take() { return std::move(names_); }

 private:
  Names names_;
};

template <class T>
Names read_by_the_client() {
  const T value{};
  NameCollector collector;
  members(collector, value);
  return collector.take();
}

class OpenApiMembers : public testing::Test {
 protected:
  OpenApiMembers() {
    std::ifstream file(DRIPLINE_OPENAPI);
    schemas_ = Json::parse(file)["components"]["schemas"];
  }
  /// `path`: of a schema, from the schemas of the document.
  Names described(const std::string& path) const {
    Names names;
    const Json& schema = schemas_.at(Json::json_pointer("/" + path));
    for (const auto& [name, unused] : schema.at("properties").items()) names.insert(name);
    return names;
  }

  Json schemas_;
};

TEST_F(OpenApiMembers, AreReadByTheClient) {
  EXPECT_EQ(read_by_the_client<ServerInfo>(), described("Server"));
  EXPECT_EQ(read_by_the_client<ServerInfo::Health>(), described("Server/properties/health"));
  EXPECT_EQ(read_by_the_client<ServerInfo::Health::Reason>(),
            described("Server/properties/health/properties/reasons/items"));
  EXPECT_EQ(read_by_the_client<ServerInfo::Dds>(), described("Server/properties/dds"));
  const std::string audit = "AuditVerification", verification = audit + "/properties/verification";
  EXPECT_EQ(read_by_the_client<AuditState>(), described(audit));
  EXPECT_EQ(read_by_the_client<AuditState::Verification>(), described(verification));
  EXPECT_EQ(read_by_the_client<AuditState::Fault>(), described(verification + "/properties/fault"));
  EXPECT_EQ(read_by_the_client<AuditState::Checkpoint>(),
            described(audit + "/properties/checkpoint"));
  EXPECT_EQ(read_by_the_client<Backups>(), described("Backups"));
  EXPECT_EQ(read_by_the_client<Backups::Backup>(), described("Backup"));
  EXPECT_EQ(read_by_the_client<Backups::Work>(), described("Backups/properties/work"));
  EXPECT_EQ(read_by_the_client<Backups::Outcome>(), described("Backups/properties/last"));
  EXPECT_EQ(read_by_the_client<Program>(), described("Program"));
  EXPECT_EQ(read_by_the_client<Revision>(), described("CommittedRevision"));
  EXPECT_EQ(read_by_the_client<Upload>(), described("Upload"));
  EXPECT_EQ(read_by_the_client<Attachment>(), described("Attachment"));
  EXPECT_EQ(read_by_the_client<SearchResult>(), described("SearchResult"));
  EXPECT_EQ(read_by_the_client<Pin>(), described("Pin"));
  EXPECT_EQ(read_by_the_client<Closure>(), described("Closure"));
  EXPECT_EQ(read_by_the_client<Closure::Call>(), described("Call"));
  EXPECT_EQ(read_by_the_client<Closure::Site>(), described("CallSite"));
  EXPECT_EQ(read_by_the_client<Machine>(), described("Machine"));
  EXPECT_EQ(read_by_the_client<Display>(), described("Display"));
  EXPECT_EQ(read_by_the_client<MachineStatus>(), described("Status"));
  EXPECT_EQ(read_by_the_client<ActiveModes>(), described("ActiveModes"));
  EXPECT_EQ(read_by_the_client<Coordinates>(), described("Coordinates"));
  EXPECT_EQ(read_by_the_client<ProgramFrame>(), described("ProgramFrame"));
  EXPECT_EQ(read_by_the_client<client::Run>(), described("Run"));
  EXPECT_EQ(read_by_the_client<client::ShownRun>(), described("RunWithParts"));
  EXPECT_EQ(read_by_the_client<client::ShownRun::Parts>(),
            described("RunWithParts/properties/parts"));
  EXPECT_EQ(read_by_the_client<client::Hold>(), described("MachineHold"));
  EXPECT_EQ(read_by_the_client<client::Setup>(), described("Setup"));
  EXPECT_EQ(read_by_the_client<client::LoadedSetup>(), described("LoadedSetup"));
  EXPECT_EQ(read_by_the_client<client::Job>(), described("Job"));
  EXPECT_EQ(read_by_the_client<client::JobList>(), described("JobList"));
  EXPECT_EQ(read_by_the_client<client::JobList::Hold>(), described("JobList/properties/hold"));
  EXPECT_EQ(read_by_the_client<client::Folder>(), described("Folder"));
  EXPECT_EQ(read_by_the_client<client::FolderFile>(), described("FolderFile"));
  EXPECT_EQ(read_by_the_client<client::Webhook>(), described("Webhook"));
  EXPECT_EQ(read_by_the_client<client::WebhookTest>(), described("WebhookTest"));
  EXPECT_EQ(read_by_the_client<Memory>(), described("Memory"));
  EXPECT_EQ(read_by_the_client<Screen>(), described("Screen"));
  EXPECT_EQ(read_by_the_client<RunStatistics>(), described("RunStatistics"));
  EXPECT_EQ(read_by_the_client<ControlValues>(), described("Values"));
  EXPECT_EQ(read_by_the_client<ControlValue>(), described("Values/properties/values/items"));
  EXPECT_EQ(read_by_the_client<ControlOutput>(), described("Values/properties/outputs/items"));
  EXPECT_EQ(read_by_the_client<ControlAnalogOutput>(), described("Values/properties/analog/items"));
  EXPECT_EQ(read_by_the_client<ControlInput>(), described("Values/properties/inputs/items"));
  EXPECT_EQ(read_by_the_client<MemoryCell>(), described("Memory/properties/cells/items"));
  EXPECT_EQ(read_by_the_client<Report>(), described("Report"));
  EXPECT_EQ(read_by_the_client<MachineReport>(), described("MachineReport"));
  EXPECT_EQ(read_by_the_client<Transfer>(), described("Transfer"));
  EXPECT_EQ(read_by_the_client<Port>(), described("Port"));
  EXPECT_EQ(read_by_the_client<Port::Line>(), described("LineState"));
  EXPECT_EQ(read_by_the_client<Port::Request>(), described("Port/properties/request"));
  EXPECT_EQ(read_by_the_client<Traffic>(), described("Traffic"));
  EXPECT_EQ(read_by_the_client<PortTest>(), described("PortTest"));
  EXPECT_EQ(read_by_the_client<RuleVerdict>(), described("RuleVerdict"));
  EXPECT_EQ(read_by_the_client<Session>(), described("IssuedSession"));
  EXPECT_EQ(read_by_the_client<User>(), described("User"));
  EXPECT_EQ(read_by_the_client<Token>(), described("IssuedToken"));
  EXPECT_EQ(read_by_the_client<MachineGroup>(), described("MachineGroup"));
  EXPECT_EQ(read_by_the_client<PortTemplates>(), described("PortTemplates"));
  EXPECT_EQ(read_by_the_client<PortTemplate>(), described("PortTemplate"));
  EXPECT_EQ(read_by_the_client<PortSetting>(), described("PortSetting"));
}

TEST_F(OpenApiMembers, OfARecordAreReadExceptTheTimeItReachedTheServer) {
  Names names = described("Record");
  EXPECT_EQ(names.erase("received"), 1U);
  EXPECT_EQ(read_by_the_client<Record>(), names);
}

}  // namespace
}  // namespace dripline::client
