#include <algorithm>
#include <thread>

#include "protocol/process/log.hpp"
#include "server/app/impl/server_parts.hpp"

/// Of a library that other servers wait for: what they are told, and the hand-over to one of them.
namespace dripline::app {
namespace {

/// A standby looks at the database every second (storage/postgresql_standby.hpp).
constexpr std::chrono::seconds kForAnswer{3};
constexpr std::chrono::milliseconds kPause{50};

/// Of those that wait: the ones that have looked since it was called, whatever the clocks are. One
/// that has just died is still listed, and would be handed a library that no server has then.
Result<std::vector<std::string>> awake_standbys(storage::OpenedStore& store) {
  using Clock = std::chrono::steady_clock;
  const auto begun = Clock::now();
  const auto before = store.waiting();
  if (!before) return fail(before.error());
  for (;;) {
    const auto waiting = store.waiting();
    if (!waiting) return fail(waiting.error());
    std::vector<std::string> awake;
    for (const auto& server : *waiting)
      if (std::ranges::find(*before, server) == before->end()) awake.push_back(server.described);
    if (!awake.empty()) return awake;
    if (waiting->empty()) {
      return fail(Errc::Conflict,
                  "no server waits for this database: start a second one with standby = yes, or "
                  "end this one");
    }
    if (Clock::now() - begun >= kForAnswer) {
      return fail(Errc::Conflict,
                  "{} waits for this database, but has not looked at it for {} s: nothing is "
                  "handed over. See whether it runs, and whether it reaches the database",
                  waiting->front().described, kForAnswer.count());
    }
    std::this_thread::sleep_for(kPause);
  }
}

std::string name_of(const storage::WaitingServer& server) {
  if (!server.gateways) return server.described;
  return fmt::format("{}; hears {} gateway{}", server.described, *server.gateways,
                     *server.gateways == 1 ? "" : "s");
}

bool has_gateway(const machines::MachineView& view) {
  return !view.machine.gateway_version.empty();
}

}  // namespace

std::optional<api::SharedLibrary> ServerParts::shared_library() {
  if (store->term() == 0) return std::nullopt;
  return api::SharedLibrary{.term = store->term(),
                            .has_standby = is_standby_expected,
                            .waiting = [this]() -> Result<std::vector<std::string>> {
                              const auto waiting = store->waiting();
                              if (!waiting) return fail(waiting.error());
                              std::vector<std::string> names;
                              for (const auto& server : *waiting) names.push_back(name_of(server));
                              return names;
                            },
                            .hand_over = [this] { return hand_over(); },
                            .leave =
                                [this] {
                                  if (on_handed_over) on_handed_over();
                                }};
}

void ServerParts::publish() {
  // Beyond this computer an address of all interfaces says nothing.
  std::string reached = url;
  for (const std::string_view any : {"//0.0.0.0:", "//[::]:"}) {
    const auto at = reached.find(any);
    if (at != std::string::npos) reached.replace(at, any.size(), "//" + host_name() + ":");
  }
  const auto published =
      store->publish({.url = reached, .signing_key = signing_key, .settings = published_settings});
  if (!published)
    process::log_warning("servers that wait do not know this one's address: {}",
                         published.error().what);
}

Result<void> ServerParts::watch_gateways(const Settings& settings) {
  if (!settings.standby || store->term() == 0) return {};
  const auto before = store->own_hand_overs();
  if (!before) return fail(before.error());
  cut_off = std::make_unique<CutOffWatch>(
      CutOffWatch::Parts{
          .store = *store,
          .health = health,
          .audit = audit,
          .clock = clock,
          .server = host_name(),
          .heard = [this] { return machine_service.heard_gateways(); },
          .is_machine_known =
              [this] { return std::ranges::any_of(machines.machines(), has_gateway); },
          .check_free = [this] { return check_lines_free(); },
          .leave =
              [this] {
                if (on_handed_over) on_handed_over();
              }},
      CutOffRule::Options{.silence = std::chrono::seconds(settings.handover_s),
                          .lease = std::chrono::milliseconds(settings.lease_ms),
                          .before = *before,
                          .began = clock.steady_now()});
  cut_off->begin();
  return {};
}

Result<void> ServerParts::check_lines_free() {
  for (const auto& view : ports.ports()) {
    storage::RunFilter active;
    active.machine = view.port.machine;
    active.state = storage::RunState::Active;
    const auto count = store->runs.count(active);
    if (!count) return fail(count.error());
    if (*count > 0) {
      return fail(Errc::Busy,
                  "port '{}' is in a run of machine '{}', which a hand-over would end: wait until "
                  "it has ended, or abort it",
                  view.port.name, view.port.machine);
    }
    if (const auto idle = ports.check_free_to_end(view.port.name); !idle) {
      return fail(Errc::Busy,
                  "{}, which a hand-over would cut off: wait until it has ended, or end it (dnc "
                  "port stop {})",
                  idle.error().what, view.port.name);
    }
  }
  return {};
}

/// A person has looked: what servers did on their own before matters no more.
Result<std::vector<std::string>> ServerParts::hand_over() {
  if (auto free = check_lines_free(); !free) return fail(free.error());
  auto awake = awake_standbys(*store);
  if (!awake) return awake;
  if (auto noted = store->note_own_hand_overs({}); !noted) return fail(noted.error());
  return awake;
}

}  // namespace dripline::app
