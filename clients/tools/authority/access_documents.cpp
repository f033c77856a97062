#include "clients/tools/authority/access_documents.hpp"

#include <array>
#include <span>

#include <fmt/format.h>

namespace dripline::authority {
namespace {

// The topics of protocol/dds, by direction; a test compares them. They are written out, because dnc
// has no DDS.
constexpr std::array kFromGateway{"dripline_Announce",     "dripline_Status",
                                  "dripline_Record",       "dripline_CommandResult",
                                  "dripline_BlockRequest", "dripline_LineData"};
constexpr std::array kFromServer{"dripline_RecordAck", "dripline_Command", "dripline_BlockData",
                                 "dripline_LineRequest"};

using Topics = std::span<const char* const>;

/// Cyclone DDS numbers its domains within a process; the number on the network is another.
constexpr std::string_view kDomains =
    "<domains><id_range><min>0</min><max>230</max></id_range></domains>";

std::string rule(std::string_view action, Topics topics, const std::string& partition) {
  std::string text = fmt::format("<{}><topics>", action);
  for (const char* topic : topics) text += fmt::format("<topic>{}</topic>", topic);
  return text + fmt::format("</topics><partitions><partition>{}</partition></partitions></{}>\n",
                            partition, action);
}

/// 2026-11-24T04:20:00Z
std::string time_text(UtcTime time) {
  constexpr std::size_t kSeconds = 19;
  return to_iso8601(time).substr(0, kSeconds) + "Z";
}

}  // namespace

std::string governance_document() {
  return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<dds><domain_access_rules><domain_rule>
{}
<allow_unauthenticated_participants>false</allow_unauthenticated_participants>
<enable_join_access_control>true</enable_join_access_control>
<discovery_protection_kind>ENCRYPT</discovery_protection_kind>
<liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
<rtps_protection_kind>NONE</rtps_protection_kind>
<topic_access_rules><topic_rule><topic_expression>*</topic_expression>
<enable_discovery_protection>true</enable_discovery_protection>
<enable_liveliness_protection>true</enable_liveliness_protection>
<enable_read_access_control>true</enable_read_access_control>
<enable_write_access_control>true</enable_write_access_control>
<metadata_protection_kind>NONE</metadata_protection_kind>
<data_protection_kind>ENCRYPT</data_protection_kind>
</topic_rule></topic_access_rules>
</domain_rule></domain_access_rules></dds>
)",
                     kDomains);
}

std::string permissions_document(const Holder& holder, const std::string& subject,
                                 const Validity& validity) {
  const bool is_server = holder.role == Role::Server;
  const std::string partition = "machine." + (is_server ? std::string("*") : holder.name);
  return fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<dds><permissions><grant name="{}">
<subject_name>{}</subject_name>
<validity><not_before>{}</not_before><not_after>{}</not_after></validity>
<allow_rule>
{}
{}{}</allow_rule>
<default>DENY</default>
</grant></permissions></dds>
)",
      holder.name, subject, time_text(validity.not_before), time_text(validity.not_after), kDomains,
      rule("publish", is_server ? Topics(kFromServer) : Topics(kFromGateway), partition),
      rule("subscribe", is_server ? Topics(kFromGateway) : Topics(kFromServer), partition));
}

}  // namespace dripline::authority
