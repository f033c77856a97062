// What is known of machines, to everybody who listens.
#include "server/app/impl/server_parts.hpp"

namespace dripline::app {

void ServerParts::note_at_broker(const machines::MachineView& view) {
  if (publisher) publisher->note(view);
  if (sparkplug) sparkplug->note(view);
}

machines::MachineListener ServerParts::published() {
  machines::MachineListener listener = api::publish_to(events);
  listener.on_record = [this, publish = listener.on_record](const auto& record) {
    measurements.note();
    if (publisher) publisher->note_record();
    publish(record);
  };
  if (publisher) {
    listener.on_machine = [this, publish = listener.on_machine](const auto& view) {
      note_at_broker(view);
      publish(view);
    };
  }
  if (mtconnect) {
    auto& observer = mtconnect->observer();
    listener.on_machine = [&observer, publish = listener.on_machine](const auto& view) {
      observer.observe(view);
      publish(view);
    };
    listener.on_record = [&observer, publish = listener.on_record](const auto& record) {
      observer.observe(record);
      publish(record);
    };
  }
  listener.on_machine = [this, publish = listener.on_machine](const auto& view) {
    machines::MachineView shown = view;
    hold_reasons.add_to(shown);
    publish(shown);
  };
  listener.on_run = [this, publish = listener.on_run](const storage::Run& run) {
    hold_reasons.note(run);
    if (fetcher) fetcher->note(run);
    publish(run);
  };
  return listener;
}

void ServerParts::show_machine(const std::string& machine) {
  const auto view = machines.machine(machine);
  if (!view) return;
  note_at_broker(*view);
  api::publish_to(events).on_machine(*view);
}

void ServerParts::show_jobs(const library::JobChange& change) {
  using Kind = library::JobChange::Kind;
  api::publish_jobs_to(events)(change);
  if (change.kind == Kind::Held || change.kind == Kind::Released)
    hold_reasons.set_queue_hold(change.machine, change.hold);
}

machines::MachineListener ServerParts::machine_listener() {
  machines::MachineListener listener = published();
  listener.on_machine = [this, publish = listener.on_machine](const machines::MachineView& view) {
    using Level = library::Health::Level;
    const auto notices = machines::notices_of(view);
    library::Health::Finding finding{
        .level = Level::Ok, .subject = "gateway", .what = {}, .detail = {}};
    if (!notices.empty()) {  // else, with every status, no text is made
      finding.level = Level::Degraded;
      finding.what = "server and a gateway do not agree";
      finding.detail = fmt::format("machine={}: {}", view.machine.name, fmt::join(notices, "; "));
    }
    health.report(view.machine.name, std::move(finding));
    publish(view);
  };
  listener.on_run = [this, publish = listener.on_run](const storage::Run& run) {
    publish(run);
    if (storage::is_finished(run.state)) offsets.note(run.machine);  // its memory is known now
  };
  return listener;
}

}  // namespace dripline::app
