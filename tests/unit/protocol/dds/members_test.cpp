// The lists of members against dripline.idl: a member that one of them lacks would never travel.
#include "protocol/dds/members.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

namespace dripline::dds::test {
namespace {

using Names = std::vector<std::string>;

/// Which members the lists do not hold: they belong to others, or to the endpoints.
const std::map<std::string, Names> kOutsideTheLists{
    {"Announce", {"heard"}},
    {"ActiveModes", {"is_present"}},
    {"Coordinates", {"is_present", "has_following_error", "has_program"}},
    {"Status", {"has_screen", "has_switches", "has_jog"}},
    {"BlockData", {"crc"}},
    {"LineStatus", {"is_present", "has_upload", "has_call", "has_transfer", "has_asked"}},
    {"LineRequest", {"crc"}},
    {"LineData", {"crc"}},
};

class NameCollector {
 public:
  void operator()(const auto& member, const auto&...) {
    if (!member.wire_name.empty()) {
      names_.emplace_back(member.wire_name);
    } else if constexpr (requires { members(*this, *member.value); }) {
      members(*this, member.value.emplace());  // its members lie among those of this message
    }
  }
  Names take() { return std::move(names_); }

 private:
  Names names_;
};

template <class Message>
Names names_in_list() {
  Message message;
  NameCollector collector;
  members(collector, message);
  return collector.take();
}

Names names_in_idl(const std::string& message) {
  std::ifstream file(DRIPLINE_IDL);
  std::stringstream text;
  text << file.rdbuf();
  const std::string idl = text.str();
  const auto begin = idl.find("struct " + message + " {");
  if (begin == std::string::npos) return {};
  std::istringstream lines(idl.substr(begin, idl.find("};", begin) - begin));
  static const std::regex kMember(R"(^ +[^/]*?([a-z_]+)(\[\d+\])?;)");
  Names names;
  const Names outside = kOutsideTheLists.contains(message) ? kOutsideTheLists.at(message) : Names{};
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!std::regex_search(line, match, kMember)) continue;
    if (std::find(outside.begin(), outside.end(), match[1]) == outside.end()) {
      names.push_back(match[1]);
    }
  }
  return names;
}

Names sorted(Names names) {
  std::ranges::sort(names);
  return names;
}

TEST(Members, AreThoseOfTheIdlInItsOrder) {
  EXPECT_EQ(names_in_list<Announce>(), names_in_idl("Announce"));
  EXPECT_EQ(names_in_list<ActiveModes>(), names_in_idl("ActiveModes"));
  EXPECT_EQ(names_in_list<Coordinates>(), names_in_idl("Coordinates"));
  // A part of the status may have grown after others came: what is new is at the end of the IDL.
  EXPECT_EQ(sorted(names_in_list<Status>()), sorted(names_in_idl("Status")));
  EXPECT_EQ(names_in_list<Record>(), names_in_idl("Record"));
  EXPECT_EQ(names_in_list<RecordAck>(), names_in_idl("RecordAck"));
  EXPECT_EQ(names_in_list<Command>(), names_in_idl("Command"));
  EXPECT_EQ(names_in_list<CommandResult>(), names_in_idl("CommandResult"));
  EXPECT_EQ(names_in_list<BlockRequest>(), names_in_idl("BlockRequest"));
  EXPECT_EQ(names_in_list<BlockData>(), names_in_idl("BlockData"));
  EXPECT_EQ(names_in_list<LineUpload>(), names_in_idl("LineUpload"));
  EXPECT_EQ(names_in_list<LineCall>(), names_in_idl("LineCall"));
  EXPECT_EQ(names_in_list<LineTransfer>(), names_in_idl("LineTransfer"));
  EXPECT_EQ(names_in_list<LineAsked>(), names_in_idl("LineAsked"));
  EXPECT_EQ(names_in_list<LineStatus>(), names_in_idl("LineStatus"));
  EXPECT_EQ(names_in_list<LineRequest>(), names_in_idl("LineRequest"));
  EXPECT_EQ(names_in_list<LineData>(), names_in_idl("LineData"));
  EXPECT_GE(names_in_idl("Status").size(), 32U);
}

}  // namespace
}  // namespace dripline::dds::test
