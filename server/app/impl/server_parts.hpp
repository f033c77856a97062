#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "server/api/api.hpp"
#include "server/api/http_server.hpp"
#include "server/app/impl/cut_off_watch.hpp"
#include "server/app/impl/lost_machines.hpp"
#include "server/app/networks.hpp"
#include "server/app/open_store.hpp"
#include "server/app/settings.hpp"
#include "server/app/state_folder.hpp"
#include "server/folders/folders.hpp"
#include "server/identity/accounts.hpp"
#include "server/imports/imports.hpp"
#include "server/library/attachments.hpp"
#include "server/library/audit_chain.hpp"
#include "server/library/audit_trail.hpp"
#include "server/library/backups.hpp"
#include "server/library/certificate_watch.hpp"
#include "server/library/control_catalog.hpp"
#include "server/library/health.hpp"
#include "server/library/history/retention.hpp"
#include "server/library/job_queue.hpp"
#include "server/library/program_search.hpp"
#include "server/library/programs.hpp"
#include "server/library/releases.hpp"
#include "server/machines/held_machines.hpp"
#include "server/machines/machine_service.hpp"
#include "server/machines/program_fetcher.hpp"
#include "server/measurements/measurements.hpp"
#include "server/mqtt/publisher.hpp"
#include "server/mqtt/sparkplug_node.hpp"
#include "server/mtconnect/agent.hpp"
#include "server/offsets/offsets.hpp"
#include "server/ports/gateway_lines.hpp"
#include "server/ports/line_machines.hpp"
#include "server/ports/port_router.hpp"
#include "server/ports/port_service.hpp"
#include "server/web/page.hpp"
#include "server/webhooks/webhooks.hpp"
#include "storage/opened_store.hpp"

namespace dripline::app {

/// What is read before anything is made.
struct Loaded {
  storage::AccountData users;
  library::ReleasePolicy policy;
  SigningKey key;
  std::string identity;  ///< of the database
};

/// Told what is wrong with something of this name; an empty fault: nothing any more.
using FaultWatch = std::function<void(const std::string& name, const std::string& fault)>;

/// In the order of their making; each may use those above it.
struct ServerParts {
  ServerParts(StateFolder state_folder, KeptStore opened,
              std::optional<backup::BackupFolder> backup_folder, const Settings& settings,
              const Clock& system_clock, const Loaded& loaded, const DdsNetwork& setup);

  machines::MachineService::Options machine_options();
  std::unique_ptr<machines::ProgramFetcher> make_fetcher() const;
  std::unique_ptr<library::Backups> make_backups(std::optional<backup::BackupFolder> to,
                                                 const Settings& settings);
  std::unique_ptr<library::Retention> make_retention(const Settings& settings,
                                                     const Loaded& loaded);
  /// Of machines with gateways and of those at the ends of lines.
  FaultWatch records_watch();
  /// Makes a finding of `subject` of each fault; `of`: what has the name.
  FaultWatch watch_faults(const char* subject, const char* of, const char* what);
  std::unique_ptr<mqtt::BrokerLink> make_link(const Settings& settings,
                                              const std::string& client) const;
  /// Null: there is no broker.
  std::unique_ptr<mqtt::Publisher> make_publisher(const Settings& settings, const Loaded& loaded);
  /// Null: Sparkplug is not spoken.
  std::unique_ptr<mqtt::SparkplugNode> make_sparkplug(const Settings& settings,
                                                      const Loaded& loaded);
  std::unique_ptr<mtconnect::Agent> make_mtconnect(const Settings& settings, const Loaded& loaded);
  /// Of the machine's last run, if it ended with an alarm.
  std::vector<storage::Record> last_alarms(const std::string& machine) const;
  /// To the listeners of events, to the broker and to the MTConnect agent.
  machines::MachineListener published();
  /// The verdict of a report template on a part: nothing of the job queue starts.
  Result<void> hold_queue(const storage::MeasuredPart& part, const std::string& reason);
  /// The same, and feed hold while its run is active. Errors: those of the hold, else of the queue.
  Result<void> hold_machine(const storage::MeasuredPart& part, const std::string& reason);
  Result<void> hold_motion(const storage::MeasuredPart& part, const std::string& reason);
  machines::MachineListener machine_listener();
  /// Where there is a broker.
  void note_at_broker(const machines::MachineView& view);
  /// To the listeners of events and to the broker: something besides its status has changed.
  void show_machine(const std::string& machine);
  /// The same of its queue, with what is known of the hold.
  void show_jobs(const library::JobChange& change);
  /// A full disk only keeps the server from storing: clients should still find it.
  void announce();
  /// nullopt: no other server can have it.
  std::optional<api::SharedLibrary> shared_library();
  /// To servers that wait for the database, where it is one that servers share.
  void publish();
  /// Who waits for the database. Errors: Unsupported, Conflict (no server does), Busy (a serial
  /// line is at work, which a hand-over would end).
  Result<std::vector<std::string>> hand_over();
  /// That no serial line is at work. Errors: Busy.
  Result<void> check_lines_free();
  /// Where other servers wait: hands over when this one is cut off from all gateways.
  Result<void> watch_gateways(const Settings& settings);
  /// Every few seconds, on the watch's thread: what a full disk has kept from being done is tried
  /// again.
  Result<void> look();
  void look_at_machines();
  /// Audit entries of a former life of the server; what cannot be read is a finding.
  void write_kept_audit();
  /// What the file has now; of a file that cannot be read what it had last stays in force.
  Result<void> revoke_certificates();
  /// The machines that are known and their tools, then the sockets.
  Result<void> open_mtconnect(const api::HttpOptions& options);
  /// The socket alone. The URL.
  Result<std::string> listen_mtconnect(const api::HttpOptions& options);
  /// It is tried again until it can listen.
  void await_mtconnect(const api::HttpOptions& options, const Error& why);
  void open_due_mtconnect();
  void report_mtconnect(const std::string& fault);
  std::vector<library::WatchedCertificate> watched_certificates() const;
  void check_on();

  const Clock& clock;
  std::optional<UtcTime> dds_certificate_expires;  ///< nullopt: without DDS Security
  std::optional<UtcTime> certificate_expires;      ///< nullopt: without TLS
  std::string revoked_file;                        ///< of clients' certificates; empty: none
  StateFolder folder;
  const bool is_standby_expected;           ///< by the settings: another server waits
  std::optional<FileLock> folder_lock;      ///< of a database elsewhere; let go after the store
  std::unique_ptr<cache::DiskCache> cache;  ///< of program text; null: none. Used by the store
  std::unique_ptr<storage::OpenedStore> store;
  std::unique_ptr<machines::ProgramFetcher> fetcher;  ///< null: there is no cache
  library::Health health;
  library::CertificateWatch certificates;
  LostMachines lost_machines;
  library::DialectCatalog catalog;
  library::LateWriter late_writer;
  library::WaitingEntries waiting_entries;
  library::AuditTrail audit;
  library::AuditChain chain;
  std::unique_ptr<library::Backups> backups;      ///< null: none are made
  std::unique_ptr<library::Retention> retention;  ///< null: everything stays
  identity::Accounts accounts;
  library::Programs programs;
  library::Releases releases;
  library::Attachments attachments;
  library::ProgramSearch search;
  library::RunHistory runs;
  api::EventHub events;
  machines::HoldReasons hold_reasons;
  library::JobQueue jobs;
  paths::ProgramPaths paths;
  imports::Imports imports;
  folders::Folders folders;
  measurements::Measurements measurements;
  library::Setups setups;
  std::unique_ptr<webhooks::Sender> webhook_sender;
  webhooks::Webhooks webhooks;
  std::unique_ptr<mqtt::BrokerLink> broker;            ///< null: there is none
  std::unique_ptr<mqtt::Publisher> publisher;          ///< likewise
  std::unique_ptr<mqtt::BrokerLink> sparkplug_broker;  ///< null: Sparkplug is not spoken
  std::unique_ptr<mqtt::SparkplugNode> sparkplug;      ///< likewise
  std::unique_ptr<mtconnect::Agent> mtconnect;         ///< null: there is none
  offsets::Offsets offsets;
  machines::MachineService machine_service;
  std::atomic<bool> are_lines_handled = false;  ///< by gateway_lines
  ports::PortService ports;
  ports::GatewayLines gateway_lines;
  ports::PortRouter port_router;
  ports::MachineRouter all_machines;
  machines::HeldMachines machines;
  api::Api api;
  web::Page page{web::embedded_assets()};
  std::unique_ptr<library::HealthWatch> watch;
  std::unique_ptr<CutOffWatch> cut_off;  ///< null: no server waits
  std::unique_ptr<api::HttpServer> http;
  std::unique_ptr<api::HttpServer> mtconnect_http;
  std::string url, mtconnect_url;
  std::optional<api::HttpOptions> mtconnect_due;  ///< set before the next one
  std::atomic<bool> is_mtconnect_due = false;
  StateFolder::Announcement announcement;
  std::atomic<bool> is_announced = true;  ///< or not yet tried
  std::string signing_key;                ///< public
  std::string published_settings;         ///< to servers that wait (shared_settings.hpp)
  std::function<void()> on_handed_over;
  SteadyTime tidied;
  std::jthread check;  ///< of a database too big to be looked through before the start
};

}  // namespace dripline::app
