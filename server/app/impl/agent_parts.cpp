#include "protocol/process/log.hpp"
#include "server/app/impl/server_parts.hpp"

/// Where the MTConnect agent listens.
namespace dripline::app {
namespace {

api::HttpHandlers mtconnect_handlers(mtconnect::Agent& agent) {
  return {
      .handle = [&agent](const api::Request& request) { return agent.handle(request); },
      .judge = [&agent](api::Request& head) { return agent.judge(head); },
  };
}

}  // namespace

Result<void> ServerParts::open_mtconnect(const api::HttpOptions& options) {
  const auto views = machines.machines();
  mtconnect->observer().reconcile(views);
  setups.on_saved([this](const storage::SetupRevision& setup, const std::string& control) {
    mtconnect->use_setup(setup, control, false);
  });
  for (const auto& view : views) {
    const auto setup = setups.find(view.machine.name, std::nullopt);
    if (setup) mtconnect->use_setup(*setup, view.machine.control, true);
  }
  auto listening = listen_mtconnect(options);
  if (!listening) return fail(listening.error());
  mtconnect_url = *std::move(listening);
  return {};
}

Result<std::string> ServerParts::listen_mtconnect(const api::HttpOptions& options) {
  auto opened = api::HttpServer::start(options, mtconnect_handlers(*mtconnect));
  if (!opened) return fail(opened.error().code, "mtconnect: {}", opened.error().what);
  mtconnect_http = *std::move(opened);
  api::HttpAddress bound = options.address;
  bound.port = mtconnect_http->port();
  std::string at = "http://" + bound.text();
  if (!bound.is_loopback)
    process::log_warning("MTConnect at {}: anybody who reaches it may read", bound.text());
  return at;
}

/// Of a server that took over: its machines do not wait for an agent.
void ServerParts::await_mtconnect(const api::HttpOptions& options, const Error& why) {
  process::log_error("{}: this server works without its MTConnect agent until it can listen there",
                     why.what);
  report_mtconnect(why.what);
  mtconnect_due = options;
  is_mtconnect_due = true;
}

void ServerParts::open_due_mtconnect() {
  const auto listening = listen_mtconnect(*mtconnect_due);
  report_mtconnect(listening ? "" : listening.error().what);
  if (!listening) return;
  is_mtconnect_due = false;
  process::log_info("MTConnect agent at {}", *listening);
}

void ServerParts::report_mtconnect(const std::string& fault) {
  using Level = library::Health::Level;
  health.report("", {.level = fault.empty() ? Level::Ok : Level::Degraded,
                     .subject = "mtconnect",
                     .what = "the MTConnect agent cannot listen at its address",
                     .detail = fault});
}

}  // namespace dripline::app
