#pragma once

#include <string>
#include <vector>

#include "server/app/settings.hpp"

namespace dripline::app {

/// What servers of one database have to have alike, or offer alike, as the active one publishes it:
/// a line "KEY VALUE" each. No secret and no path is in it.
std::string shared_settings(const Settings& settings);

/// What would change if a server with `own` took over from one with `active`; both as
/// shared_settings makes them. Pure.
struct SettingsDifference {
  std::vector<std::string> forbids;  ///< gateways would not find it: it cannot take over
  std::vector<std::string> others;   ///< for people: "policy is none, and at the active server ..."
};
/// Of an active server of an older version nothing is known: there is no difference.
SettingsDifference compare_settings(const std::string& own, const std::string& active);

}  // namespace dripline::app
