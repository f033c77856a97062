#pragma once

#include <nlohmann/json_fwd.hpp>

#include "server/ports/port_control.hpp"

/// The JSON of serial ports and their traffic. Pure; absent values are null.
namespace dripline::api {

nlohmann::json transfer_json(const ports::PortTransfer& transfer);
nlohmann::json port_json(const ports::PortView& view);
/// `bytes` in hexadecimal: any byte, one line.
nlohmann::json traffic_json(const ports::PortTraffic& traffic);
nlohmann::json port_test_json(const ports::PortTest& test);
nlohmann::json verdict_json(const ports::RuleVerdict& verdict);
/// Every template with all its settings, and the text of each setting.
nlohmann::json port_templates_json();

}  // namespace dripline::api
