#include "server/app/standby_faults.hpp"

#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace dripline::app {
namespace {

struct FaultRow {
  const char* subject;
  std::string StandbyFaults::*fault;
  const char* message;  ///< for any client
  const char* summary;  ///< for the status line
};

constexpr std::array kFaultRows{
    FaultRow{"store", &StandbyFaults::database,
             "the database that this standby waits for cannot be reached",
             "the database cannot be reached"},
    FaultRow{
        "store", &StandbyFaults::place,
        "this standby tried to take over and could not yet: the active server was there again, "
        "or its place in the database is locked",
        "it could not take over yet"},
    FaultRow{"dds", &StandbyFaults::ports,
             "a UDP port that this server needs for gateways is in use: it cannot take over",
             "its UDP ports are in use"},
    FaultRow{
        "dds", &StandbyFaults::network,
        "the DDS settings of this server are not those of the active one, whose gateways would not "
        "find it: it cannot take over",
        "its DDS settings are not the active server's"},
    FaultRow{
        "mtconnect", &StandbyFaults::agent,
        "the address of this server's MTConnect agent is in use or not allowed: it would take over "
        "without the agent",
        "its MTConnect address cannot be used"},
    FaultRow{
        "settings", &StandbyFaults::settings,
        "this server's settings are not those of the active one: after a takeover it would work "
        "differently",
        "its settings are not the active server's"},
    FaultRow{"clock", &StandbyFaults::clock, "the clocks of this server and of its database differ",
             "its clock differs from the database's"},
    FaultRow{"disk", &StandbyFaults::disk, "the disk of this server is full or nearly full",
             "its disk is full or nearly full"},
};

}  // namespace

bool StandbyFaults::is_well() const {
  for (const FaultRow& row : kFaultRows)
    if (!(this->*row.fault).empty()) return false;
  return true;
}

std::string StandbyFaults::note() const {
  std::string note;
  const auto add = [&note](const std::string& words) {
    note += (note.empty() ? "" : "; ") + words;
  };
  if (!agent.empty()) add(agent);
  if (!settings.empty()) add(settings);
  if (!clock.empty()) add(clock);
  if (!disk.empty()) add(disk);
  return note;
}

std::string StandbyFaults::summary() const {
  std::string text;
  for (const FaultRow& row : kFaultRows)
    if (!(this->*row.fault).empty()) text += fmt::format(", {}", row.summary);
  return text;
}

nlohmann::json StandbyFaults::health() const {
  auto reasons = nlohmann::json::array();
  for (const FaultRow& row : kFaultRows) {
    if ((this->*row.fault).empty()) continue;
    reasons.push_back({{"subject", row.subject}, {"status", "degraded"}, {"message", row.message}});
  }
  return {{"status", is_well() ? "ok" : "degraded"}, {"role", "standby"}, {"reasons", reasons}};
}

}  // namespace dripline::app
