// A request to the MTConnect agent: target, parameters, XPath. Properties: it is answered by a
// document with a status of the standard, also a second time from what was kept, and a part of a
// stream is as long as it says.
#include <cstdlib>
#include <optional>

#include "server/mtconnect/agent.hpp"

namespace {

using namespace dripline;

const SystemClock kClock;

std::unique_ptr<mtconnect::Agent> make_agent() {
  auto agent = std::make_unique<mtconnect::Agent>(
      mtconnect::Agent::Options{.sender = "fuzz", .plant = "fuzz", .instance = 1}, kClock);
  for (const char* name : {"lathe-1", "mill-1"}) {
    machines::MachineView view;
    view.machine.name = name;
    view.is_connected = true;
    view.status.emplace();
    view.status.edit().axes = 0b100111;
    agent->observer().observe(view);
  }
  storage::SetupRevision setup;
  setup.machine = "mill-1";
  setup.number = 1;
  setup.text = "[[tool]]\nnumber = 3\nlength = 80.0\n";
  agent->use_setup(setup, "fanuc", true);
  return agent;
}

void expect(bool holds) {
  if (!holds) std::abort();
}

void check_part(const std::string& part) {
  if (part.empty()) return;
  const auto begin = part.find("\r\n\r\n");
  const auto length = part.find("Content-length: ");
  expect(begin != std::string::npos && length < begin);
  const std::string xml = part.substr(begin + 4, std::strtoull(&part[length + 16], nullptr, 10));
  expect(xml.starts_with("<?xml") && xml.ends_with(">\n"));
}

int check(mtconnect::Agent& agent, const api::Request& request) {
  const auto response = agent.handle(request);
  if (response.timed) {
    if (const auto part = response.timed->take()) check_part(*part);
    return response.status;
  }
  expect(response.body.starts_with("<?xml") && response.body.ends_with(">\n"));
  const bool is_error = response.body.find("<MTConnectError ") != std::string::npos;
  expect(is_error == (response.status != 200));
  return response.status;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto kAgent = make_agent();
  const auto target = api::parse_target({reinterpret_cast<const char*>(data), size});
  if (!target) return 0;
  api::Request request;
  request.method = "GET";
  request.target = *target;
  const int status = check(*kAgent, request);
  expect(check(*kAgent, request) == status);
  return 0;
}
