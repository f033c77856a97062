#include "tests/unit/clients/support/server_json.hpp"

#include "protocol/base/digest.hpp"

namespace dripline::test_support {

using nlohmann::json;

json revision_json(const std::string& program, const std::string& name_key, std::uint64_t number,
                   const std::string& content) {
  return {{name_key, program},
          {"revision", number},
          {"size", content.size()},
          {"sha256", sha256(content).hex()},
          {"title", nullptr},
          {"control", "centurion"},
          {"comment", nullptr},
          {"author", "test"},
          {"created", "2026-11-21T07:40:06.123456Z"},
          {"held", false},
          {"accepted", nullptr},
          {"state", "draft"},
          {"released", nullptr},
          {"withdrawn", nullptr}};
}

json machine_json(const std::string& name) {
  return {{"name", name},
          {"control", "centurion"},
          {"description", "a lathe"},
          {"gateway_version", "0.1.0"},
          {"connected", true},
          {"clock_ahead_seconds", nullptr},
          {"notices", json::array()},
          {"first_seen", "2026-11-21T07:00:00Z"},
          {"last_seen", "2026-11-21T07:40:06.123456Z"},
          {"status", nullptr}};
}

json port_json(const std::string& name) {
  return {{"name", name},
          {"machine", "mill-3"},
          {"address", "/dev/ttyUSB0"},
          {"template", "tnc155"},
          {"settings", {{"baud", "4800"}}},
          {"rules", nullptr},
          {"enabled", true},
          {"effective", {{"line", "4800e71"}, {"flow", "xonxoff"}, {"baud", "4800"}}},
          {"sends_at_once", true},
          {"open", true},
          {"fault", nullptr},
          {"line",
           {{"phase", "idle"},
            {"stopped", false},
            {"stopping", false},
            {"waiting_for", nullptr},
            {"without_limit", false}}},
          {"run", nullptr},
          {"transfer", nullptr},
          {"reception", nullptr},
          {"sent", 0},
          {"received", 0},
          {"waiting_since", nullptr},
          {"request", nullptr}};
}

json setup_json(const std::string& machine, const std::string& text) {
  return {{"machine", machine},
          {"revision", 4},
          {"size", text.size()},
          {"sha256", std::string(64, 'b')},
          {"comment", ""},
          {"author", "cam"},
          {"created", "2026-11-21T07:40:00Z"},
          {"text", text}};
}

json run_json(const std::string& id, const std::string& state) {
  return {{"id", id},
          {"machine", "lathe-1"},
          {"program", "O0200"},
          {"revision", 1},
          {"sha256", std::string(64, 'a')},
          {"size", 1000},
          {"control", "centurion"},
          {"state", state},
          {"sent", 1000},
          {"accepted", 50},
          {"executed", 42},
          {"line", 42},
          {"sequence", nullptr},
          {"reason", nullptr},
          {"content_verified", nullptr},
          {"author", "test"},
          {"created", "2026-11-21T07:40:00Z"},
          {"started", "2026-11-21T07:40:01Z"},
          {"ended", state == "completed" ? json("2026-11-21T07:41:06Z") : json(nullptr)},
          {"outputs", 3},
          {"setup", nullptr},
          {"allowed_as", "open"},
          {"approval", nullptr}};
}

}  // namespace dripline::test_support
