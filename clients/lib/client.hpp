#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/lib/api_types.hpp"
#include "clients/lib/http.hpp"
#include "clients/lib/reply.hpp"
#include "clients/lib/request_types.hpp"
#include "clients/lib/server_location.hpp"
#include "clients/lib/value_types.hpp"

namespace dripline::client {

/// Typed calls for every endpoint of server/api/README.md; each is one HTTP exchange and is not
/// repeated. One thread at a time.
class Client {
 public:
  explicit Client(ServerAddress address, const HttpOptions& options = {});
  /// Of servers that share a library, the one that has it (shared_http.hpp); at least one.
  explicit Client(std::vector<ServerAddress> servers, const HttpOptions& options = {});
  /// Takes any transport; for tests.
  Client(ServerAddress address, std::unique_ptr<Http> http);

  /// Of several servers the one that answered last, else the first.
  const ServerAddress& address() const;
  const std::vector<ServerAddress>& servers() const { return servers_; }

  Reply<void> health();
  Reply<ServerInfo> server();
  /// Has it hand its library over to a server that waits.
  Reply<ServerInfo::Sharing> drain();
  Reply<Backups> backups();
  /// These begin it; `Backups::work` and `last` tell how it goes.
  Reply<Backups> make_backup();
  Reply<Backups> verify_backup(std::string_view id);
  Reply<void> remove_backup(std::string_view id);

  /// Verifies the whole trail; may take seconds.
  Reply<AuditState> verify_audit();
  /// Passes the trail to `sink` as it arrives; false from it ends the call.
  Reply<void> export_audit(const std::function<bool(std::string_view)>& sink);

  Reply<std::vector<Program>> programs(Page page);
  /// The next of those that are chosen, past the name `after`.
  Reply<std::vector<Program>> programs(const ProgramChoice& choice, std::uint64_t limit,
                                       const std::string& after);
  Reply<SearchResult> search(const SearchQuery& query);
  /// `revision`: for the CAM file; absent: the latest.
  Reply<ProgramHistory> describe_program(std::string_view name,
                                         std::optional<std::uint64_t> revision,
                                         const FieldChange& change);
  /// Those of the program and of `revision`; absent: of all its revisions.
  Reply<std::vector<Attachment>> attachments(std::string_view program,
                                             std::optional<std::uint64_t> revision);
  Reply<Upload> open_attachment(const AttachmentRequest& request);
  Reply<Attachment> commit_attachment(std::string_view upload, const std::string& sha256);
  Reply<std::string> attachment_bytes(const AttachmentRange& range);
  Reply<void> remove_attachment(const AttachmentRequest& attachment);
  Reply<ProgramHistory> program(std::string_view name);
  /// `overrides_protection`: also removes a program that is protected against erasing.
  Reply<void> remove_program(std::string_view name, bool overrides_protection = false);
  /// The latest revision unless one is named.
  Reply<Revision> copy_program(std::string_view from, const std::string& to,
                               std::optional<std::uint64_t> revision);
  Reply<ProgramHistory> rename_program(std::string_view from, const std::string& to);
  Reply<Revision> accept_revision(std::string_view name, std::uint64_t revision);
  struct DecisionRequest {
    std::string program;
    std::uint64_t revision = 0;
    std::string comment;
    // Of a release:
    bool has_closure = false;            ///< what it calls is pinned, and released with it
    std::string machine = {};            ///< its newest setup binds codes to programs
    std::vector<std::string> with = {};  ///< NAME or NAME@REVISION
  };
  struct ClosureQuery {
    std::string program;
    std::optional<std::uint64_t> revision;  ///< absent: the latest
    std::string machine;
    std::vector<std::string> with;
  };
  Reply<Closure> closure(const ClosureQuery& query);
  /// `step`: submit, approve, release, withdraw.
  Reply<Revision> decide(std::string_view step, const DecisionRequest& request);
  /// The revision, a draft again; nullopt: it came from a machine and is hidden.
  Reply<std::optional<Revision>> reject_revision(const DecisionRequest& request);
  Reply<RevisionStates> revision_states(std::string_view name, std::uint64_t revision);
  /// What machines sent; pending ones oldest first, decided ones the latest first.
  Reply<std::vector<Import>> imports(bool is_pending, Page page);
  /// The server's JSON (ComparedImport of openapi.json).
  Reply<std::string> import(std::string_view program, std::uint64_t revision);
  struct AcceptRequest {
    std::string program;
    std::uint64_t revision = 0;
    std::string target;  ///< the program that gets it; empty: as what it came
    std::string comment;
  };
  Reply<Revision> accept_import(const AcceptRequest& request);
  /// The comment is the reason.
  Reply<void> reject_import(const DecisionRequest& request);
  struct JobRequest {
    std::string machine, program;
    std::optional<std::uint64_t> revision;
    std::uint64_t quantity = 1, parts_per_run = 1;
    std::string counts;  ///< made or good; empty: made
    std::string comment;
    std::optional<std::uint64_t> place;  ///< 1: the first; absent: at the end
  };
  /// Open ones in their order; otherwise done and removed ones, newest first.
  Reply<JobList> jobs(std::string_view machine, bool is_open, Page page);
  Reply<Job> add_job(const JobRequest& request);
  Reply<Job> move_job(std::string_view machine, std::uint64_t job, std::uint64_t place);
  Reply<void> remove_job(std::string_view machine, std::uint64_t job);
  /// The next one unless one is named.
  Reply<BegunRun> start_job(std::string_view machine, std::optional<std::uint64_t> job);
  Reply<void> hold_jobs(std::string_view machine, const std::string& reason);
  Reply<void> release_jobs(std::string_view machine);

  Reply<std::vector<Webhook>> webhooks();
  /// With its secret. `kinds` empty: all.
  Reply<Webhook> add_webhook(const std::string& name, const std::string& url,
                             const std::vector<std::string>& kinds);
  Reply<void> remove_webhook(std::string_view name);
  Reply<WebhookTest> test_webhook(std::string_view name);

  Reply<std::vector<Folder>> folders();
  /// Newest first.
  Reply<std::vector<FolderFile>> folder_files(std::string_view folder, Page page);
  /// The server's JSON (clients/tools/comparison/README.md).
  Reply<std::string> compare(const ComparisonQuery& query);
  /// The server's JSON (server/paths/README.md, "A check").
  Reply<std::string> check(const CheckQuery& query);
  /// Returns fewer bytes than requested only at the end of the content.
  Reply<Content> content(const ContentRange& range);

  Reply<Upload> open_upload(const UploadRequest& request);
  Reply<Upload> upload(std::string_view id);
  Reply<Upload> put_piece(std::string_view id, const Piece& piece);
  Reply<Revision> commit_upload(std::string_view id, const CommitRequest& request);
  Reply<void> drop_upload(std::string_view id);

  /// All of them, in the order of their names.
  Reply<std::vector<Machine>> machines();
  Reply<Machine> machine(std::string_view name);

  /// Newest first, without their texts.
  Reply<std::vector<Setup>> setups(std::string_view machine, Page page);
  /// The newest unless a revision is named.
  Reply<Setup> setup(std::string_view machine, std::optional<std::uint64_t> revision);
  Reply<Setup> save_setup(const SetupRequest& request);
  /// Which one is in a control at the end of a line; not found while it was never stated.
  Reply<LoadedSetup> loaded_setup(std::string_view machine);
  /// `revision` nothing: it is not known any more.
  Reply<LoadedSetup> note_loaded_setup(std::string_view machine,
                                       std::optional<std::uint64_t> revision);
  /// What the machine's control retained after its runs, newest first; after `run` alone unless
  /// that is empty.
  Reply<std::vector<Memory>> memories(std::string_view machine, std::string_view run, Page page);

  /// What the control of the machine holds now: a page of the values whose names begin so.
  Reply<ControlValues> control_values(std::string_view machine, std::string_view beginning,
                                      std::uint64_t offset);

  Reply<BegunRun> start_run(const RunRequest& request);
  /// `at`: executed, block=1234, L7, N120, T3, time=2026-11-23T15:04:05Z.
  Reply<Run> restart_run(std::string_view run, std::string_view at);
  /// Blocks keyed in at an idle machine. Failures: Refused also while a run is active.
  Reply<BegunRun> key_in(std::string_view machine, std::string_view text);
  /// A datum, or with a tool its length, from where the axes of a machine without a run are.
  Reply<PositionSet> set_position(std::string_view machine, const PositionToSet& setting);
  /// One step of an axis of a machine without a run; returns when the axis rests.
  Reply<JogDone> jog(std::string_view machine, const JogToMake& step);
  /// Lets the jog that is held by this word move on for 300 ms.
  Reply<void> keep_jog(std::string_view machine, std::string_view hold);
  /// The position of the axes of these letters as the words of a block.
  Reply<PlaybackBlock> play_back(std::string_view machine, std::string_view axes);
  Reply<std::vector<Run>> runs(const RunQuery& query);
  Reply<Run> run(std::string_view id);
  /// With what was measured of it, and who holds it.
  Reply<ShownRun> shown_run(std::string_view id);
  /// Passes the text to `sink`; false from it ends the call.
  Reply<void> run_attestation(std::string_view id,
                              const std::function<bool(std::string_view)>& sink);
  Reply<void> command(std::string_view run, const CommandRequest& request);
  /// Switches and overrides of the machine's panel; they need no run.
  Reply<void> command_machine(std::string_view machine, const CommandRequest& request);
  /// The gateway that waits becomes the machine's.
  Reply<void> confirm_gateway(std::string_view machine);
  Reply<void> remove_machine(std::string_view machine);
  Reply<std::vector<Record>> records(std::string_view run, std::string_view kind, Page page);

  Reply<std::vector<Port>> ports();
  Reply<Port> port(std::string_view name);
  Reply<Port> save_port(const PortRequest& request);
  Reply<void> remove_port(std::string_view name);
  /// `programs`: NAME or NAME@REVISION, sent in this order.
  Reply<Transfer> send_programs(std::string_view port, const std::vector<std::string>& programs);
  Reply<void> receive_program(std::string_view port);
  /// The control of this port was reset after a program had been broken off.
  Reply<void> confirm_reset(std::string_view port);
  Reply<void> stop_transfer(std::string_view port);
  Reply<PortTest> test_port(std::string_view name);
  Reply<RuleVerdict> test_rules(std::string_view name, std::string_view text);
  /// Passes JSON lines of Traffic to `sink` as they arrive; false from it ends the call.
  Reply<void> recording(std::string_view name, const std::function<bool(std::string_view)>& sink);
  Reply<PortTemplates> port_templates();

  /// Answers with a secret for the next calls.
  Reply<Session> sign_in(const SignInRequest& request);
  Reply<Session> session();
  Reply<void> sign_out();
  Reply<std::vector<User>> users();
  Reply<User> user(std::string_view name);
  Reply<User> add_user(const UserRequest& request);
  Reply<User> change_user(std::string_view name, const UserChange& change);
  /// `current`: of the caller who changes the own one; else empty.
  Reply<void> set_password(std::string_view name, const std::string& password,
                           const std::string& current);
  Reply<void> remove_user(std::string_view name);
  /// Sessions too.
  Reply<std::vector<Token>> tokens(std::string_view user);
  Reply<Token> add_token(const TokenRequest& request);
  Reply<void> revoke_token(std::string_view user, std::string_view name);
  Reply<std::vector<MachineGroup>> machine_groups();
  Reply<MachineGroup> add_group(std::string_view name);
  Reply<void> remove_group(std::string_view name);
  Reply<MachineGroup> add_to_group(std::string_view group, std::string_view machine);
  Reply<MachineGroup> remove_from_group(std::string_view group, std::string_view machine);

  Reply<std::vector<Report>> reports(const ReportQuery& query);
  /// `format`: text, csv or json. Passes the bytes to `sink` as they arrive; false from it ends
  /// the call.
  Reply<void> export_report(std::string_view run, std::string_view format,
                            const std::function<bool(std::string_view)>& sink);
  Reply<std::vector<MachineReport>> machine_reports();
  /// Like `export_report`, for what a machine printed outside any run.
  Reply<void> export_machine_report(std::string_view machine, std::string_view format,
                                    const std::function<bool(std::string_view)>& sink);

  // Report templates and what follows from them. Texts are the server's JSON (openapi.json).
  Reply<std::string> report_templates();
  Reply<std::string> report_template(std::string_view name, std::optional<std::uint64_t> version);
  Reply<std::string> push_report_template(std::string_view name, std::string_view text);
  Reply<void> remove_report_template(std::string_view name);
  Reply<std::string> report_template_assignments();
  Reply<void> assign_report_template(const TemplateAssignment& assignment);
  Reply<void> unassign_report_template(const TemplateAssignment& assignment);
  Reply<std::string> measurements(const MeasurementQuery& query);
  /// All of them, oldest first. `format`: csv or jsonl. Passes the bytes to `sink` as they arrive;
  /// false from it ends the call.
  Reply<void> export_measurements(const MeasurementQuery& query, std::string_view format,
                                  const std::function<bool(std::string_view)>& sink);
  Reply<std::string> parts(const MeasurementQuery& query);
  Reply<std::string> report_findings(const MeasurementQuery& query);
  /// Derives a run again; without a name by the templates in force.
  Reply<std::string> derive_measurements(std::string_view run, const std::string& name,
                                         std::optional<std::uint64_t> version);
  /// What retention moved out of the database.
  Reply<std::string> archives(Page page);
  /// Applies retention now.
  Reply<std::string> make_archives();

  // Offset proposals; answers are the server's JSON.
  Reply<std::string> offsets(const OffsetQuery& query);
  Reply<std::string> offset(std::uint64_t id);
  /// `decision`: approve or reject.
  Reply<std::string> decide_offset(std::string_view machine, std::uint64_t id,
                                   std::string_view decision, const std::string& comment);
  Reply<std::string> evaluate_offsets(std::string_view machine);
  Reply<std::string> offset_rules(std::string_view machine);
  Reply<std::string> save_offset_rules(std::string_view machine, std::string_view text);
  /// `target` empty: all. `limit`: setups that are looked through, newest first.
  Reply<std::string> offset_history(std::string_view machine, std::string_view target,
                                    std::uint64_t limit);
  Reply<std::string> offsets_of_run(std::string_view run);

 private:
  Reply<void> send_command(const std::string& path, const CommandRequest& request);
  Reply<HttpResponse> exchange(const HttpRequest& request);
  /// All three send `body` unless it is empty.
  Reply<void> perform(HttpRequest request, std::string_view body = {});
  /// The answer as it came.
  Reply<std::string> fetch_text(HttpRequest request, std::string_view body = {});
  template <class T>
  Reply<T> fetch(HttpRequest request, std::string_view body = {});
  template <class T>
  Reply<std::vector<T>> fetch_list(const std::string& path, const char* member);

  std::vector<ServerAddress> servers_;
  std::unique_ptr<Http> http_;
};

}  // namespace dripline::client
